#pragma once

#include <cstddef>
#include <cstdint>

namespace saccade {

/// Points (mm, depth z = 0: none) and unit normals ((0,0,0) = none) of cells, row by row without gaps.
struct OrientedCells {
  const float *x, *y, *z;
  const float *nx, *ny, *nz;
};

/// What the surface may do before a concave edge is seen: the sine of the angle by which the normals of the
/// two ends turn towards each other.
struct ConcaveLimit {
  float sine, sine_per_metre;  ///< up to 1 m, and how much more for each metre beyond
  float reach;                 ///< of the depth; ends farther away in depth lie behind a jump
};

/// Sets marked[i] for those of the cells begin..end on which a concave edge lies between the cells `step`
/// before and behind; leaves the others as they are.
void mark_concave(const OrientedCells& cells, std::size_t begin, std::size_t end, std::size_t step,
                  const ConcaveLimit& limit, std::uint8_t* marked);

/// Writes to linked[0..count) whether cells i and i + step are of one surface: the step in depth, or the
/// distance from the tangent plane of one of the two (which a slanted surface keeps small), is below the jump
/// of cell i, jump * z * max(1, z / 1 m).
void find_linked(const OrientedCells& cells, std::size_t count, std::size_t step, float jump,
                 std::uint8_t* linked);

}  // namespace saccade
