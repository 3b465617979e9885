#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "attention/surface_grid.hpp"

namespace saccade {

/// A SurfaceGrid cut into segments, the candidates for proto-objects. A segment is what grows from any of its
/// cells over links between convex or coplanar neighbours; a concave edge or a depth jump ends it. The cells
/// of the concave edges themselves go to the nearest segment.
///
/// A segment that is large and mostly one plane is a *supporting plane*: table, floor, wall. What does not
/// lie in its plane is cut off from it and makes segments of its own, so that an object is not lost if some
/// gap in its concave edge let the table in. Keeps its memory between frames. Thread safety: one grow() at a
/// time per object; reading is free.
class SurfaceSegments {
 public:
  static constexpr int kNone = -1;

  void grow(const SurfaceGrid& grid);

  int count() const { return static_cast<int>(segments_.size()); }
  /// Segment of each cell, row by row; kNone = no depth there, or too few cells around to be a surface.
  const std::vector<int>& of_cell() const { return of_cell_; }
  bool is_supporting_plane(int segment) const {
    return segments_[static_cast<std::size_t>(segment)].supporting_plane;
  }

  /// A supporting plane in inverse depth: 1/z = a*col + b*row + c, 1/mm, with cells as unit.
  struct Plane {
    double a = 0, b = 0, c = 0;
  };

 private:
  struct Segment {
    int cells = 0;
    bool supporting_plane = false;
  };

  void grow_convex(const SurfaceGrid& grid);
  void flood_edges(const SurfaceGrid& grid);
  void find_supporting_planes(const SurfaceGrid& grid);
  double fit_plane(const SurfaceGrid& grid, int segment, Plane& plane) const;
  void cut_from_plane(const SurfaceGrid& grid, int segment, const Plane& plane);
  void grow_rest(const SurfaceGrid& grid);

  int cols_ = 0;
  std::vector<int> of_cell_;
  std::vector<int> queue_;
  std::vector<Segment> segments_;
};

}  // namespace saccade
