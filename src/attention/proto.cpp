#include "attention/proto.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "attention/confidence.hpp"
#include "attention/selector.hpp"

namespace saccade {
namespace {

constexpr int kCell = SurfaceGrid::kCellPx;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The same surface as that of a cell with depth z0.
bool on_surface(float z, float z0) { return z > 0 && std::abs(z - z0) <= SurfaceGrid::kSameSurface * z0; }

// The cell's pixel of the highest saliency on its surface. There is one: the pixel that its depth was
// gathered around.
cv::Point fixated_pixel(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, int row, int col, float z0) {
  cv::Point best(-1, -1);
  for (int r = row * kCell; r < std::min((row + 1) * kCell, depth_mm.rows); ++r)
    for (int c = col * kCell; c < std::min((col + 1) * kCell, depth_mm.cols); ++c)
      if (on_surface(depth_mm(r, c), z0) && (best.x < 0 || saliency(r, c) > saliency(best))) best = {c, r};
  return best;
}

void mean_of_cells(const cv::Mat1f& saliency, int rows, int cols, std::vector<float>& means) {
  means.assign(at(rows) * at(cols), 0.0F);
  constexpr float kShare = 1.0F / (kCell * kCell);
  for (int r = 0; r < saliency.rows; ++r) {
    const float* line = saliency[r];
    float* out = &means[at(r / kCell) * at(cols)];
    const int whole = saliency.cols / kCell;
    for (int c = 0; c < whole; ++c) {
      const float* s = line + c * kCell;
      out[c] += ((s[0] + s[1]) + (s[2] + s[3])) * kShare;
    }
    for (int c = whole * kCell; c < saliency.cols; ++c) out[whole] += line[c] * kShare;
  }
}

// Appends to the text in place, without a string of its own: no memory is taken for a frame.
void add_reason(int doubtful, double min_confidence, std::string& reasons) {
  fmt::format_to(std::back_inserter(reasons), "{}{} point{} with a confidence below {}",
                 reasons.empty() ? "" : "; ", doubtful, doubtful == 1 ? "" : "s", min_confidence);
}

}  // namespace

void smooth_cells(const cv::Mat1f& saliency, std::vector<float>& scratch, std::vector<float>& smooth) {
  constexpr std::array<float, 5> kWeights = {70.0F / 256, 56.0F / 256, 28.0F / 256, 8.0F / 256, 1.0F / 256};
  const int rows = (saliency.rows + kCell - 1) / kCell, cols = (saliency.cols + kCell - 1) / kCell;
  mean_of_cells(saliency, rows, cols, scratch);
  smooth.assign(scratch.size(), 0.0F);
  const auto add = [](const float* from, float* to, int count, float weight) {
    for (int i = 0; i < count; ++i) to[i] += from[i] * weight;
  };
  for (int r = 0; r < rows; ++r)
    for (int d = -4; d <= 4; ++d)
      if (r + d >= 0 && r + d < rows)
        add(&scratch[at((r + d) * cols)], &smooth[at(r * cols)], cols, kWeights[at(std::abs(d))]);
  scratch.swap(smooth);
  std::fill(smooth.begin(), smooth.end(), 0.0F);
  for (int r = 0; r < rows; ++r)
    for (int d = -4; d <= 4; ++d)
      if (const int count = cols - std::abs(d); count > 0)
        add(&scratch[at(r * cols + std::max(0, d))], &smooth[at(r * cols + std::max(0, -d))], count,
            kWeights[at(std::abs(d))]);
}

ProtoSelector::ProtoSelector(int fixations, double min_confidence)
    : fixations_(fixations), min_confidence_(min_confidence) {
  if (fixations < 1) throw std::invalid_argument("ProtoSelector: at least one fixation");
}

void ProtoSelector::select(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
                           Attention& attention) {
  begin_attention(saliency, depth_mm, camera, attention);
  grid_.build(depth_mm, camera);
  segments_.grow(grid_);
  borders_.measure(grid_, segments_);
  smooth_cells(saliency, scratch_, smooth_);
  set_rays(depth_mm.size(), camera);
  make_return_table();
  weigh();
  list_cells_of_segments();
  int first_cell = 0, doubtful = 0;
  for (int k = 0; k < fixations_; ++k) {
    int row = 0, col = 0;
    if (!find_winner(row, col)) {
      attention.ended_early = k == 0 ? "nothing salient where there is depth"
                                     : "nothing salient is left beside the proto-objects found";
      break;
    }
    const int cell = row * grid_.cols() + col;
    if (k == 0) first_cell = cell;
    collect_proto_object(row, col);
    inhibit();
    discount_around(row, col);
    const float sure = confidence_at(cell, first_cell);
    if (static_cast<double>(sure) < min_confidence_) {
      ++doubtful;
      continue;
    }
    const cv::Point pixel = fixated_pixel(saliency, depth_mm, row, col, grid_.depth_mm()[at(cell)]);
    Fixation fixation = fixation_at(saliency, depth_mm, camera, pixel.y, pixel.x);
    fixation.proto_object =
        paint(depth_mm, attention.masks, static_cast<int>(attention.fixations.size()) + 1);
    fixation.confidence = sure;
    attention.fixations.push_back(fixation);
  }
  if (doubtful > 0) add_reason(doubtful, min_confidence_, attention.ended_early);
}

float ProtoSelector::confidence_at(int cell, int first_cell) const {
  const int segment = segments_.of_cell()[at(cell)];
  ConfidenceCues cues;
  cues.relative_saliency = smooth_[at(cell)] / smooth_[at(first_cell)];
  cues.without_segment = segment == SurfaceSegments::kNone;
  if (!cues.without_segment) {
    cues.front_share = borders_.front_share(segment);
    cues.on_supporting_plane = segments_.is_supporting_plane(segment);
  }
  return confidence(cues);
}

void ProtoSelector::weigh() {
  weight_.reserve(grid_.size() / SurfaceSegments::kFewestCells);
  weight_.resize(at(segments_.count()));
  for (int segment = 0; segment < segments_.count(); ++segment)
    weight_[at(segment)] = (segments_.is_supporting_plane(segment) ? kSupportingPlaneWeight : 1) *
                           (borders_.front_share(segment) < kFrontShare ? kBehindWeight : 1);
  row_best_.assign(at(grid_.rows()), 0.0F);
  value_ = smooth_;
  for (int r = 0, i = 0; r < grid_.rows(); ++r)
    for (int c = 0; c < grid_.cols(); ++c, ++i) {
      const int segment = segments_.of_cell()[at(i)];
      if (grid_.depth_mm()[at(i)] == 0)
        value_[at(i)] = 0;
      else if (segment != SurfaceSegments::kNone)
        value_[at(i)] *= weight_[at(segment)];
      row_best_[at(r)] = std::max(row_best_[at(r)], value_[at(i)]);
    }
}

// The cells sorted by segment s from cells_of_segment_[first_of_segment_[s + 1]] on, those of no segment
// first.
void ProtoSelector::list_cells_of_segments() {
  first_of_segment_.assign(at(segments_.count() + 2), 0);
  for (int segment : segments_.of_cell()) ++first_of_segment_[at(segment + 1)];
  int sum = 0;
  for (int& first : first_of_segment_) {
    const int cells = first;
    first = sum;
    sum += cells;
  }
  cells_of_segment_.resize(grid_.size());
  for (int i = 0; i < static_cast<int>(grid_.size()); ++i)
    cells_of_segment_[at(first_of_segment_[at(segments_.of_cell()[at(i)] + 1)]++)] = i;
  // Each entry has moved to the end of its segment, which is the beginning of the next.
  std::move_backward(first_of_segment_.begin(), first_of_segment_.end() - 1, first_of_segment_.end());
  first_of_segment_[0] = 0;
  object_.reserve(grid_.size());
  in_object_.assign(grid_.size(), 0);
}

bool ProtoSelector::find_winner(int& row, int& col) const {
  const auto best = std::max_element(row_best_.begin(), row_best_.end());
  if (!(*best > 0)) return false;
  row = static_cast<int>(best - row_best_.begin());
  const auto begin = value_.begin() + row * grid_.cols();
  col = static_cast<int>(std::find(begin, begin + grid_.cols(), *best) - begin);
  return true;
}

void ProtoSelector::collect_proto_object(int row, int col) {
  const int cols = grid_.cols(), segment = segments_.of_cell()[at(row * cols + col)];
  const bool whole = segment != SurfaceSegments::kNone && !segments_.is_supporting_plane(segment);
  object_.clear();
  for (int k = first_of_segment_[at(segment + 1)]; k < first_of_segment_[at(segment + 2)]; ++k) {
    const int i = cells_of_segment_[at(k)], down = i / cols - row, right = i % cols - col;
    if (whole || down * down + right * right <= kDiscCells * kDiscCells) object_.push_back(i);
  }
}

// Sets the values of the proto-object and of its margin to 0. Only cells at its rim reach beyond it.
void ProtoSelector::inhibit() {
  const int cols = grid_.cols(), rows = grid_.rows();
  for (int i : object_) in_object_[at(i)] = 1;
  for (int i : object_) {
    const int r = i / cols, c = i % cols;
    value_[at(i)] = 0;
    const bool inner = r > 0 && c > 0 && r + 1 < rows && c + 1 < cols && in_object_[at(i - 1)] &&
                       in_object_[at(i + 1)] && in_object_[at(i - cols)] && in_object_[at(i + cols)];
    if (!inner) clear_disc(r, c, kMarginCells);
  }
  for (int i : object_) in_object_[at(i)] = 0;
}

void ProtoSelector::make_return_table() {
  const float sigma = kReturnReach * static_cast<float>(grid_.cols());
  return_table_.resize(at(std::max(grid_.rows(), grid_.cols())));
  for (std::size_t d = 0; d < return_table_.size(); ++d) {
    const float x = static_cast<float>(d) / sigma;
    return_table_[d] = std::exp(-0.5F * x * x);
  }
}

void ProtoSelector::discount_around(int row, int col) {
  const int cols = grid_.cols();
  for (int r = 0; r < grid_.rows(); ++r) {
    const float depth = kReturnDepth * return_table_[at(std::abs(r - row))];
    float* value = &value_[at(r * cols)];
    float best = 0;
    for (int c = 0; c < cols; ++c) {
      value[c] *= 1 - depth * return_table_[at(std::abs(c - col))];
      best = std::max(best, value[c]);
    }
    row_best_[at(r)] = best;
  }
}

void ProtoSelector::clear_disc(int row, int col, int radius) {
  for (int v = -radius; v <= radius; ++v) {
    if (row + v < 0 || row + v >= grid_.rows()) continue;
    for (int u = -radius; u <= radius; ++u)
      if (v * v + u * u <= radius * radius && col + u >= 0 && col + u < grid_.cols())
        value_[at((row + v) * grid_.cols() + col + u)] = 0;
  }
}

void ProtoSelector::set_rays(cv::Size size, const Intrinsics& camera) {
  ray_x_.resize(at(size.width));
  ray_y_.resize(at(size.height));
  for (int c = 0; c < size.width; ++c) ray_x_[at(c)] = static_cast<float>((c - camera.cx) / camera.fx);
  for (int r = 0; r < size.height; ++r) ray_y_[at(r)] = static_cast<float>((r - camera.cy) / camera.fy);
}

// Writes `rank` on the pixels of the present proto-object and measures them.
ProtoObject ProtoSelector::paint(const cv::Mat1f& depth_mm, cv::Mat1w& masks, int rank) const {
  ProtoObject object;
  constexpr float kFar = std::numeric_limits<float>::max();
  cv::Point3f low(kFar, kFar, kFar), high(-kFar, -kFar, -kFar);
  cv::Point3d sum;
  for (int i : object_) {
    const float z0 = grid_.depth_mm()[at(i)];
    const int top = i / grid_.cols() * kCell, left = i % grid_.cols() * kCell;
    const int bottom = std::min(top + kCell, depth_mm.rows), right = std::min(left + kCell, depth_mm.cols);
    cv::Point3f cell_sum;  // of few pixels, so that float holds it well
    int pixels = 0;
    for (int r = top; r < bottom; ++r) {
      const float* line = depth_mm[r];
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
