#include "tracking/own_colour.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {

cv::Vec2f chromaticity(const SurfaceGrid& grid, const cv::Mat3b& colour, int cell) {
  constexpr int kMiddle = SurfaceGrid::kCellPx / 2 - 1;
  const int row = cell / grid.cols() * SurfaceGrid::kCellPx + kMiddle,
            col = cell % grid.cols() * SurfaceGrid::kCellPx + kMiddle;
  cv::Vec3i sum;
  for (int r = row; r < std::min(colour.rows, row + 2); ++r)
    for (int c = col; c < std::min(colour.cols, col + 2); ++c) sum += cv::Vec3i(colour(r, c));
  const int all = sum[0] + sum[1] + sum[2];
  if (all < 4 * OwnColour::kDarkest) return {-1, -1};
  return cv::Vec2f(static_cast<float>(sum[0]), static_cast<float>(sum[2])) / static_cast<float>(all);
}

float distance(const cv::Vec2f& a, const cv::Vec2f& b) {
  const float blue = a[0] - b[0], red = a[1] - b[1], green = -blue - red;
  return std::sqrt(blue * blue + green * green + red * red);
}

std::optional<cv::Vec2f> OwnColour::find(std::span<const cv::Vec2f> chromaticities, double share) {
  bins_.assign(kBins * kBins, 0);
  const auto bin = [](float part) { return std::min(kBins - 1, static_cast<int>(part * kBins)); };
  for (const cv::Vec2f& colour : chromaticities)
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
  for (const cv::Vec2f& colour : chromaticities) {
    if (colour[0] < 0 || std::abs(bin(colour[0]) - fullest / kBins) > 1 ||
        std::abs(bin(colour[1]) - fullest % kBins) > 1)
      continue;
    sum += colour;
    ++count;
  }
  if (count == 0) return std::nullopt;
  const cv::Vec2f own = sum / static_cast<float>(count);
  const auto like = std::count_if(chromaticities.begin(), chromaticities.end(), [&](const cv::Vec2f& colour) {
    return colour[0] >= 0 && distance(colour, own) <= kReach;
  });
  if (static_cast<double>(like) < share * static_cast<double>(chromaticities.size())) return std::nullopt;
  return own;
}

}  // namespace saccade
