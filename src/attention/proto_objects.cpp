#include "attention/proto_objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
  ray_x_.resize(at(size.width));
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
  ProtoObject object;
  constexpr float kFar = std::numeric_limits<float>::max();
  cv::Point3f low(kFar, kFar, kFar), high(-kFar, -kFar, -kFar);
  cv::Point3d sum;
  for (int i : cells) {
    const float z0 = grid_->depth_mm()[at(i)];
    const int top = i / grid_->cols() * kCell, left = i % grid_->cols() * kCell;
    const int bottom = std::min(top + kCell, depth_mm_->rows),
              right = std::min(left + kCell, depth_mm_->cols);
    cv::Point3f cell_sum;  // of few pixels, so that float holds it well
    int pixels = 0;
    for (int r = top; r < bottom; ++r) {
      const float* line = (*depth_mm_)[r];
      ushort* mask = masks[r];
      for (int c = left; c < right; ++c) {
        const float z = line[c];
        if (!on_surface(z, z0)) continue;
        mask[c] = static_cast<ushort>(rank);
        ++pixels;
        const cv::Point3f p(ray_x_[at(c)] * z, ray_y_[at(r)] * z, z);
        cell_sum += p;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
    sum += cv::Point3d(cell_sum);
    object.pixels += pixels;
  }
  if (object.pixels == 0) return object;
  object.centroid_mm = sum / object.pixels;
  object.extent_mm = high - low;
  return object;
}

}  // namespace saccade
