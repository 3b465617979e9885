#include "attention/proto_objects.hpp"

#include <algorithm>
#include <cmath>

#include "attention/simd/cell_points.hpp"

namespace saccade {
namespace {

// The same surface as that of a cell with depth z0.
bool on_surface(float z, float z0) { return z > 0 && std::abs(z - z0) <= SurfaceGrid::kSameSurface * z0; }

}  // namespace

void ProtoObjects::begin(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat1f& depth_mm,
                         const Intrinsics& camera) {
  grid_ = &grid;
  segments_ = &segments;
  depth_mm_ = &depth_mm;
  cells_of_segments_.list(segments);
  cells_.reserve(grid.size());
  set_rays(camera);
}

void ProtoObjects::set_rays(const Intrinsics& camera) {
  ray_x_.resize(at(grid_->cols()));
  ray_y_.resize(at(grid_->rows()));
  const std::size_t side = at(kCellPx);
  for (std::size_t p = 0; p < side * side; ++p) {  // the pixels of a cell
    const std::size_t u = p % side, v = p / side;
    for (std::size_t c = 0; c < ray_x_.size(); ++c)
      ray_x_[c][p] = static_cast<float>((static_cast<double>(c * side + u) - camera.cx) / camera.fx);
    for (std::size_t r = 0; r < ray_y_.size(); ++r)
      ray_y_[r][p] = static_cast<float>((static_cast<double>(r * side + v) - camera.cy) / camera.fy);
  }
}

const std::vector<int>& ProtoObjects::around(int cell) {
  const int cols = grid_->cols(), row = cell / cols, col = cell % cols,
            segment = segments_->of_cell()[at(cell)];
  const bool whole = segments_->is_of_thing(segment);
  cells_.clear();
  for (const int i : cells_of_segments_.of(segment)) {
    const int down = i / cols - row, right = i % cols - col;
    if (whole || down * down + right * right <= kDiscCells * kDiscCells) cells_.push_back(i);
  }
  return cells_;
}

// There is one: the pixel that the cell's depth was gathered around.
cv::Point ProtoObjects::fixated_pixel(const cv::Mat1f& saliency, int cell) const {
  const int top = cell / grid_->cols() * kCellPx, left = cell % grid_->cols() * kCellPx;
  const float z0 = grid_->depth_mm()[at(cell)];
  cv::Point best(-1, -1);
  for (int r = top; r < std::min(top + kCellPx, depth_mm_->rows); ++r)
    for (int c = left; c < std::min(left + kCellPx, depth_mm_->cols); ++c)
      if (on_surface((*depth_mm_)(r, c), z0) && (best.x < 0 || saliency(r, c) > saliency(best)))
        best = {c, r};
  return best;
}

ProtoObject ProtoObjects::paint(const std::vector<int>& cells, cv::Mat1w& masks, int rank) const {
  const CellImage image{*depth_mm_, grid_->depth_mm().data(), grid_->cols(), ray_x_, ray_y_};
  const PointSums points =
      paint_points(image, cells, SurfaceGrid::kSameSurface, static_cast<std::uint16_t>(rank), masks);
  ProtoObject object;
  object.pixels = points.count;
  if (points.count == 0) return object;
  object.centroid_mm = cv::Point3d(points.sum[0], points.sum[1], points.sum[2]) / points.count;
  object.extent_mm = {points.high[0] - points.low[0], points.high[1] - points.low[1],
                      points.high[2] - points.low[2]};
  return object;
}

}  // namespace saccade
