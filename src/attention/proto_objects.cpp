#include "attention/proto_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <opencv2/core/hal/intrin.hpp>

#include "attention/cell_pixels.hpp"

namespace saccade {
namespace {

constexpr int kCell = SurfaceGrid::kCellPx;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The same surface as that of a cell with depth z0.
bool on_surface(float z, float z0) { return z > 0 && std::abs(z - z0) <= SurfaceGrid::kSameSurface * z0; }

}  // namespace

void ProtoObjects::begin(const SurfaceGrid& grid, const SurfaceSegments& segments, const cv::Mat1f& depth_mm,
                         const Intrinsics& camera) {
  grid_ = &grid;
  segments_ = &segments;
  depth_mm_ = &depth_mm;
  list_cells_of_segments();
  set_rays(camera);
}

// The cells sorted by segment s from cells_of_segment_[first_of_segment_[s + 1]] on, those of no segment
// first.
void ProtoObjects::list_cells_of_segments() {
  first_of_segment_.assign(at(segments_->count() + 2), 0);
  for (int segment : segments_->of_cell()) ++first_of_segment_[at(segment + 1)];
  int sum = 0;
  for (int& first : first_of_segment_) {
    const int cells = first;
    first = sum;
    sum += cells;
  }
  cells_of_segment_.resize(grid_->size());
  for (int i = 0; i < static_cast<int>(grid_->size()); ++i)
    cells_of_segment_[at(first_of_segment_[at(segments_->of_cell()[at(i)] + 1)]++)] = i;
  // Each entry has moved to the end of its segment, which is the beginning of the next.
  std::move_backward(first_of_segment_.begin(), first_of_segment_.end() - 1, first_of_segment_.end());
  first_of_segment_[0] = 0;
  cells_.reserve(grid_->size());
}

void ProtoObjects::set_rays(const Intrinsics& camera) {
  const cv::Size size = depth_mm_->size();
  ray_x_.assign(at(grid_->cols() * kCell), 0.0F);
  ray_y_.resize(at(size.height));
  for (int c = 0; c < size.width; ++c) ray_x_[at(c)] = static_cast<float>((c - camera.cx) / camera.fx);
  for (int r = 0; r < size.height; ++r) ray_y_[at(r)] = static_cast<float>((r - camera.cy) / camera.fy);
}

const std::vector<int>& ProtoObjects::around(int cell) {
  const int cols = grid_->cols(), row = cell / cols, col = cell % cols,
            segment = segments_->of_cell()[at(cell)];
  const bool whole = segment != SurfaceSegments::kNone && !segments_->is_supporting_plane(segment);
  cells_.clear();
  for (int k = first_of_segment_[at(segment + 1)]; k < first_of_segment_[at(segment + 2)]; ++k) {
    const int i = cells_of_segment_[at(k)], down = i / cols - row, right = i % cols - col;
    if (whole || down * down + right * right <= kDiscCells * kDiscCells) cells_.push_back(i);
  }
  return cells_;
}

// There is one: the pixel that the cell's depth was gathered around.
cv::Point ProtoObjects::fixated_pixel(const cv::Mat1f& saliency, int cell) const {
  const int top = cell / grid_->cols() * kCell, left = cell % grid_->cols() * kCell;
  const float z0 = grid_->depth_mm()[at(cell)];
  cv::Point best(-1, -1);
  for (int r = top; r < std::min(top + kCell, depth_mm_->rows); ++r)
    for (int c = left; c < std::min(left + kCell, depth_mm_->cols); ++c)
      if (on_surface((*depth_mm_)(r, c), z0) && (best.x < 0 || saliency(r, c) > saliency(best)))
        best = {c, r};
  return best;
}

ProtoObject ProtoObjects::paint(const std::vector<int>& cells, cv::Mat1w& masks, int rank) const {
  using Lanes = cv::v_float32x4;  // the columns of a cell
  static_assert(kCell == Lanes::nlanes);
  constexpr float kFar = std::numeric_limits<float>::max();
  const Lanes one = cv::v_setall_f32(1), far = cv::v_setall_f32(kFar), near = cv::v_setall_f32(-kFar);
  std::array<Lanes, 3> low = {far, far, far}, high = {near, near, near};
  cv::Point3d sum;
  ProtoObject object;
  for (int i : cells) {
    const int row = i / grid_->cols(), col = i % grid_->cols();
    const CellPixels pixels(*depth_mm_, row, col);
    const Lanes z0 = cv::v_setall_f32(grid_->depth_mm()[at(i)]);
    const Lanes reach = z0 * cv::v_setall_f32(SurfaceGrid::kSameSurface);
    const Lanes ray_x = cv::v_load(&ray_x_[at(col * kCell)]);
    Lanes count = cv::v_setzero_f32();
    std::array<Lanes, 3> cell_sum = {count, count, count};  // of few pixels, so that float holds it well
    for (int v = 0; v < pixels.rows(); ++v) {
      const int r = row * kCell + v;
      const Lanes z = cv::v_load(pixels.row(v));
      const Lanes on_it = (cv::v_abs(z - z0) <= reach) & (z > cv::v_setzero_f32());
      const std::array<Lanes, 3> point = {ray_x * z, cv::v_setall_f32(ray_y_[at(r)]) * z, z};
      count += one & on_it;
      for (std::size_t k = 0; k < 3; ++k) {
        cell_sum[k] += point[k] & on_it;
        low[k] = cv::v_min(low[k], cv::v_select(on_it, point[k], far));
        high[k] = cv::v_max(high[k], cv::v_select(on_it, point[k], near));
      }
      const int bits = cv::v_signmask(on_it);
      ushort* const mask = masks[r] + col * kCell;
      for (int u = 0; u < pixels.cols(); ++u)
        mask[u] = static_cast<ushort>((bits >> u & 1) != 0 ? rank : mask[u]);
    }
    sum += cv::Point3d(cv::v_reduce_sum(cell_sum[0]), cv::v_reduce_sum(cell_sum[1]),
                       cv::v_reduce_sum(cell_sum[2]));
    object.pixels += cvRound(cv::v_reduce_sum(count));
  }
  if (object.pixels == 0) return object;
  object.centroid_mm = sum / object.pixels;
  object.extent_mm = {cv::v_reduce_max(high[0]) - cv::v_reduce_min(low[0]),
                      cv::v_reduce_max(high[1]) - cv::v_reduce_min(low[1]),
                      cv::v_reduce_max(high[2]) - cv::v_reduce_min(low[2])};
  return object;
}

}  // namespace saccade
