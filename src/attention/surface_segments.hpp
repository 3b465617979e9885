#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "attention/plane_search.hpp"
#include "attention/surface_grid.hpp"

namespace saccade {

/// A SurfaceGrid cut into segments, the candidates for proto-objects. A segment is what grows from any of its
/// cells over links between convex or coplanar neighbours; a concave edge or a depth jump ends it. The cells
/// of the concave edges themselves go to the nearest segment.
///
/// A segment that holds a large plane is a *supporting plane*: table, floor, wall (README.md, sections 3 and
/// 4). Cells off the plane are cut off and make segments of their own, so that an object is not lost if some
/// gap in its concave edge let the table in. Keeps its memory between frames. Thread safety: one grow() at a
/// time per object; reading is free.
class SurfaceSegments {
 public:
  static constexpr int kNone = -1;
  static constexpr int kFewestCells = 6;  ///< of a segment

  void grow(const SurfaceGrid& grid);

  int count() const { return static_cast<int>(segments_.size()); }
  /// Segment of each cell, row by row; kNone = no depth there, or too few cells around to be a surface.
  const std::vector<int>& of_cell() const { return of_cell_; }
  bool is_supporting_plane(int segment) const {
    return segments_[static_cast<std::size_t>(segment)].supporting_plane;
  }
  /// Whether it is the surface of a thing: neither kNone nor a supporting plane.
  bool is_of_thing(int segment) const { return segment != kNone && !is_supporting_plane(segment); }

  /// Makes a segment of `cells`, which belong to segments now; for what depth does not show.
  void cut(const std::vector<int>& cells);
  /// Whether cut() has made it.
  bool is_cut(int segment) const { return segments_[static_cast<std::size_t>(segment)].cut; }

 private:
  struct Segment {
    int cells = 0;
    bool supporting_plane = false;
    bool cut = false;
  };

  void grow_convex(const SurfaceGrid& grid);
  void flood_edges(const SurfaceGrid& grid);
  void find_supporting_planes(const SurfaceGrid& grid);
  void cut_from_plane(const SurfaceGrid& grid, int segment, const InversePlane& plane);
  void grow_rest(const SurfaceGrid& grid);

  PlaneSearch plane_search_;
  std::vector<int> of_cell_;
  std::vector<int> queue_;
  std::vector<int> cells_;  ///< of the segment that may be a plane
  std::vector<Segment> segments_;
};

}  // namespace saccade
