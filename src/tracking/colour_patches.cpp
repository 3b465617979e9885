#include "tracking/colour_patches.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

// Blue and red, as parts of b + g + r, of the four pixels in the middle of a cell; dark ones have none.
cv::Vec2f chromaticity(const SurfaceGrid& grid, const cv::Mat3b& colour, int cell) {
  constexpr int kMiddle = SurfaceGrid::kCellPx / 2 - 1;
  const int row = cell / grid.cols() * SurfaceGrid::kCellPx + kMiddle,
            col = cell % grid.cols() * SurfaceGrid::kCellPx + kMiddle;
  cv::Vec3i sum;
  for (int r = row; r < std::min(colour.rows, row + 2); ++r)
    for (int c = col; c < std::min(colour.cols, col + 2); ++c) sum += cv::Vec3i(colour(r, c));
  const int all = sum[0] + sum[1] + sum[2];
  if (all < 4 * ColourPatches::kDarkest) return {-1, -1};
  return cv::Vec2f(static_cast<float>(sum[0]), static_cast<float>(sum[2])) / static_cast<float>(all);
}

float distance(const cv::Vec2f& a, const cv::Vec2f& b) {
  const float blue = a[0] - b[0], red = a[1] - b[1], green = -blue - red;
  return std::sqrt(blue * blue + green * green + red * red);
}

}  // namespace

void ColourPatches::cut(const SurfaceGrid& grid, const cv::Mat3b& colour, SurfaceSegments& segments) {
  if (colour.empty()) return;
  colour_.reserve(grid.size());
  patch_.reserve(grid.size());
  cells_of_segments_.list(segments);
  measure_areas(grid, segments);
  state_.assign(grid.size(), State::none);
  const int count = segments.count();
  for (int segment = 0; segment < count; ++segment) {
    if (segments.is_supporting_plane(segment) || area_mm2_[at(segment)] < kLeastArea_mm2) continue;
    const std::span<const int> cells = cells_of_segments_.of(segment);
    if (!mark_others(grid, colour, cells)) continue;
    for (const int seed : cells) {
      if (state_[at(seed)] != State::other) continue;
      collect(grid, seed);
      if (!is_strip(grid)) segments.cut(patch_);
      for (const int cell : patch_) state_[at(cell)] = State::done;
    }
  }
}

void ColourPatches::measure_areas(const SurfaceGrid& grid, const SurfaceSegments& segments) {
  area_mm2_.assign(at(segments.count()), 0);
  const double per_square = 1 / (grid.camera().fx * grid.camera().fy);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const int segment = segments.of_cell()[i];
    if (segment == SurfaceSegments::kNone) continue;
    const double z = static_cast<double>(grid.depth_mm()[i]);
    area_mm2_[at(segment)] += z * z * per_square;
  }
}

// The mean colour around the fullest bin; none if too few cells have it.
std::optional<cv::Vec2f> ColourPatches::own_colour() {
  bins_.assign(kBins * kBins, 0);
  const auto bin = [](float part) { return std::min(kBins - 1, static_cast<int>(part * kBins)); };
  for (const cv::Vec2f& colour : colour_)
    if (colour[0] >= 0) ++bins_[at(bin(colour[0]) * kBins + bin(colour[1]))];
  int most = -1, fullest = 0;
  for (int b = 1; b + 1 < kBins; ++b)
    for (int r = 1; r + 1 < kBins; ++r) {
      int sum = 0;
      for (int i = b - 1; i <= b + 1; ++i)
        for (int j = r - 1; j <= r + 1; ++j) sum += bins_[at(i * kBins + j)];
      if (sum <= most) continue;
      most = sum;
      fullest = b * kBins + r;
    }
  cv::Vec2f sum;
  int count = 0;
  for (const cv::Vec2f& colour : colour_) {
    if (colour[0] < 0 || std::abs(bin(colour[0]) - fullest / kBins) > 1 ||
        std::abs(bin(colour[1]) - fullest % kBins) > 1)
      continue;
    sum += colour;
    ++count;
  }
  if (count == 0) return std::nullopt;
  const cv::Vec2f own = sum / static_cast<float>(count);
  const auto like = std::count_if(colour_.begin(), colour_.end(), [&](const cv::Vec2f& colour) {
    return colour[0] >= 0 && distance(colour, own) <= kOwnColour;
  });
  if (static_cast<double>(like) < kOwnShare * static_cast<double>(colour_.size())) return std::nullopt;
  return own;
}

// False if the segment has no colour of its own.
bool ColourPatches::mark_others(const SurfaceGrid& grid, const cv::Mat3b& colour,
                                std::span<const int> cells) {
  colour_.clear();
  for (const int cell : cells) colour_.push_back(chromaticity(grid, colour, cell));
  const auto own = own_colour();
  if (!own) return false;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (colour_[k][0] >= 0 && distance(colour_[k], *own) > kOtherColour) state_[at(cells[k])] = State::other;
  return true;
}

void ColourPatches::collect(const SurfaceGrid& grid, int seed) {
  const int cols = grid.cols();
  patch_.assign(1, seed);
  state_[at(seed)] = State::patch;
  const auto visit = [&](int cell) {
    if (state_[at(cell)] != State::other) return;
    state_[at(cell)] = State::patch;
    patch_.push_back(cell);
  };
  for (std::size_t next = 0; next < patch_.size(); ++next) {
    const int cell = patch_[next], row = cell / cols, col = cell % cols;
    if (row > 0) visit(cell - cols);
    if (row + 1 < grid.rows()) visit(cell + cols);
    if (col > 0) visit(cell - 1);
    if (col + 1 < cols) visit(cell + 1);
  }
}

// True if no cell has only cells of the patch within kReach.
bool ColourPatches::is_strip(const SurfaceGrid& grid) const {
  const int cols = grid.cols();
  return std::none_of(patch_.begin(), patch_.end(), [&](int cell) {
    const int row = cell / cols, col = cell % cols;
    if (row < kReach || col < kReach || row + kReach >= grid.rows() || col + kReach >= cols) return false;
    for (int v = -kReach; v <= kReach; ++v)
      for (int u = -kReach; u <= kReach; ++u)
        if (state_[at(cell + v * cols + u)] != State::patch) return false;
    return true;
  });
}

}  // namespace saccade
