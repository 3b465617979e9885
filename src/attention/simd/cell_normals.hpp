#pragma once

#include <cstddef>

#include "core/intrinsics.hpp"

namespace saccade {

/// Cells up to this far away in rows and columns take part in a normal: 5 x 5.
inline constexpr int kNormalReach = 2;

/// Depths of cells (mm, 0 = none) and their inverses (1/mm, 0 = none), row by row, with kNormalReach cells
/// without depth on all four sides.
struct FramedCells {
  const float *depth, *inverse;  ///< of the first cell of the frame
  std::size_t stride;            ///< from row to row
};

struct NormalRows {
  float *x, *y, *z;
};

/// Writes the unit normals of the `cols` cells of a row, (0,0,0) = none: README.md of the room, section 1.
/// camera: of the cells. same_surface: of the depth; cells beyond it take no part.
void find_normals(const FramedCells& cells, const Intrinsics& camera, float same_surface, std::size_t row,
                  std::size_t cols, const NormalRows& normals);

}  // namespace saccade
