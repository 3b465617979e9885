#pragma once

#include <cmath>
#include <optional>

#include "attention/surface_grid.hpp"

namespace saccade {

/// Depths that differ by less, as a part of the depth, are of one surface seen twice.
constexpr double kSameDepth = 0.03;

/// How a surface seen at some depth relates to a point that was expected there.
enum class Seen { same, nearer, farther, nothing };

inline Seen compare_depth(float seen_mm, double expected_mm) {
  const double z = static_cast<double>(seen_mm);
  if (z == 0) return Seen::nothing;
  if (std::abs(z - expected_mm) <= kSameDepth * expected_mm) return Seen::same;
  return z < expected_mm ? Seen::nearer : Seen::farther;
}

/// A place in a grid, in cells from the middle of cell (0, 0).
struct CellPlace {
  double row, col;
};

/// Where a point in camera frame is seen; none if it is not before the camera.
inline std::optional<CellPlace> place_of(const SurfaceGrid& grid, const cv::Point3d& point_mm) {
  if (!(point_mm.z > 0)) return std::nullopt;
  const Intrinsics& camera = grid.camera();
  return CellPlace{camera.fy * point_mm.y / point_mm.z + camera.cy,
                   camera.fx * point_mm.x / point_mm.z + camera.cx};
}

inline bool in_grid(const SurfaceGrid& grid, int row, int col) {
  return row >= 0 && col >= 0 && row < grid.rows() && col < grid.cols();
}

/// The cell on which a point in camera frame is seen; -1 = out of view.
inline int cell_of(const SurfaceGrid& grid, const cv::Point3d& point_mm) {
  const auto place = place_of(grid, point_mm);
  if (!place || std::abs(place->row) > 1e6 || std::abs(place->col) > 1e6) return -1;
  const int row = cvRound(place->row), col = cvRound(place->col);
  return in_grid(grid, row, col) ? row * grid.cols() + col : -1;
}

/// The point of a cell with depth, in camera frame.
inline cv::Point3d cell_point_mm(const SurfaceGrid& grid, int cell) {
  const int row = cell / grid.cols(), col = cell % grid.cols();
  return grid.camera().point_mm(row, col,
                                static_cast<double>(grid.depth_mm()[static_cast<std::size_t>(cell)]));
}

}  // namespace saccade
