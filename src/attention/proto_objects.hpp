#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "attention/cells_of_segments.hpp"
#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"

namespace saccade {

/// The proto-objects of a frame: the cells that belong to an attention point, their pixels and their place in
/// space. Keeps its memory between frames. Thread safety: one call at a time per object.
class ProtoObjects {
 public:
  static constexpr int kDiscCells = 10;  ///< radius; 40 px

  /// Takes the frame. All must stay as they are until the last call for it.
  void begin(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat1f& depth_mm,
             const Intrinsics& camera);

  /// Cells of the proto-object of a cell with depth: its segment; on a supporting plane, or where there is no
  /// segment, the part that lies within kDiscCells. Valid until the next call.
  const std::vector<int>& around(int cell);

  /// The pixel of a cell with depth that has the highest saliency and lies on the cell's surface; ties:
  /// lowest row, then lowest column.
  [[nodiscard]] cv::Point fixated_pixel(const cv::Mat1f& saliency, int cell) const;

  /// Writes `rank` into `masks` (H x W) on the pixels of the cells that lie on their cell's surface, and
  /// measures these.
  ProtoObject paint(const std::vector<int>& cells, cv::Mat1w& masks, int rank) const;

 private:
  void set_rays(const Intrinsics& camera);

  const SurfaceGrid* grid_ = nullptr;
  const SurfaceSegments* segments_ = nullptr;
  const cv::Mat1f* depth_mm_ = nullptr;
  // One value for each pixel of a cell: x/z by column of cells, y/z by row of cells.
  using CellRays = std::array<float, static_cast<std::size_t>(SurfaceGrid::kCellPx) * SurfaceGrid::kCellPx>;
  std::vector<CellRays> ray_x_, ray_y_;
  CellsOfSegments cells_of_segments_;
  std::vector<int> cells_;
};

}  // namespace saccade
