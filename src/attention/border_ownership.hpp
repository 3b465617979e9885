#pragma once

#include <vector>

#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"

namespace saccade {

/// Which side of a border between segments is the figure, and which goes on behind it (README.md, section 5).
/// Keeps its memory between frames. Thread safety: one measure() at a time per object; reading is free.
class BorderOwnership {
 public:
  static constexpr int kWidestGap = 10;  ///< cells without depth that a border may be wide

  /// Looks along the rows and columns of cells from each cell of a segment to the next cell with depth; where
  /// that is of another segment, or there is none, a piece of the segment's border is found.
  void measure(const SurfaceGrid& grid, const SurfaceSegments& segments);

  /// Part 0..1 of the segment's border that it owns: behind it the depth is larger by a jump.
  float front_share(int segment) const;

 private:
  // Of one segment, in sides of cells.
  struct Border {
    int owned = 0, all = 0;
  };

  void add_end(int i);
  void add_pair(int i, int j, int step, bool linked);
  void add_side(int i, int j, bool may_own);

  const float* depth_mm_ = nullptr;  ///< of the grid, during measure()
  const int* segment_ = nullptr;     ///< of each cell, during measure()
  std::vector<Border> borders_;      ///< by segment
  std::vector<int> above_;           ///< last cell with depth of each column
};

}  // namespace saccade
