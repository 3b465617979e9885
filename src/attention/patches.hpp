#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "attention/surface_grid.hpp"

namespace saccade {

/// A SurfaceGrid cut into patches, the candidates for proto-objects. A patch is what grows from any of its
/// cells over links between convex or coplanar neighbours; a concave edge or a depth jump ends it. The cells
/// of the concave edges themselves go to the nearest patch.
///
/// A patch that is large and mostly one plane is a *support*: table, floor, wall. What does not lie in its
/// plane is cut off from it and makes patches of its own, so that an object is not lost if some gap in its
/// concave edge let the table in.
/// Keeps its memory between frames. Thread safety: one grow() at a time per object; reading is free.
class Patches {
 public:
  static constexpr int kNone = -1;

  void grow(const SurfaceGrid& grid);

  int count() const { return static_cast<int>(patches_.size()); }
  /// Patch of each cell, row by row; kNone = no depth there, or too few cells around to be a surface.
  const std::vector<int>& of_cell() const { return of_cell_; }
  bool is_support(int patch) const { return patches_[static_cast<std::size_t>(patch)].support; }

  /// Plane of a support in inverse depth: 1/z = a*col + b*row + c, 1/mm, with cells as unit.
  struct Plane {
    double a = 0, b = 0, c = 0;
  };

 private:
  struct Patch {
    int cells = 0;
    bool support = false;
  };

  void grow_convex(const SurfaceGrid& grid);
  void flood_edges(const SurfaceGrid& grid);
  void find_supports(const SurfaceGrid& grid);
  double fit_plane(const SurfaceGrid& grid, int patch, Plane& plane) const;
  void cut_from_support(const SurfaceGrid& grid, int patch, const Plane& plane);
  void grow_rest(const SurfaceGrid& grid);

  int cols_ = 0;
  std::vector<int> of_cell_;
  std::vector<int> queue_;
  std::vector<Patch> patches_;
};

}  // namespace saccade
