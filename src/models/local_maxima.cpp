#include "models/local_maxima.hpp"

#include <algorithm>

namespace saccade {
namespace {

// Whether no neighbour is higher and none before it in reading order as high: a plateau counts about once.
bool is_peak(const cv::Mat1f& map, int row, int col) {
  const float value = map(row, col);
  for (int r = std::max(0, row - 1); r <= std::min(map.rows - 1, row + 1); ++r)
    for (int c = std::max(0, col - 1); c <= std::min(map.cols - 1, col + 1); ++c) {
      const bool before = r < row || (r == row && c < col);
      if (map(r, c) > value || (before && map(r, c) == value)) return false;
    }
  return true;
}

}  // namespace

void attenuate_border(cv::Mat1f& map) {
  const int border = (std::max(map.rows, map.cols) + 10) / 20;
  const auto share = [&](int i, int n) {
    return static_cast<float>(std::min({i + 1, n - i, border + 1})) / static_cast<float>(border + 1);
  };
  for (int r = 0; r < map.rows; ++r) {
    const float down = share(r, map.rows);
    for (int c = 0; c < map.cols; ++c) map(r, c) *= down * share(c, map.cols);
  }
}

void promote_few_peaks(cv::Mat1f& map) {
  constexpr float kCounts = 0.1F;
  const auto [low, high] = std::minmax_element(map.begin(), map.end());
  const float bottom = *low, range = *high - *low;
  if (!(range >= kSameValue)) {
    map.setTo(0);
    return;
  }
  for (float& value : map) value = (value - bottom) / range;
  double sum = 0;
  int peaks = 0;
  for (int r = 0; r < map.rows; ++r)
    for (int c = 0; c < map.cols; ++c)
      if (map(r, c) >= kCounts && is_peak(map, r, c)) {
        sum += static_cast<double>(map(r, c));
        ++peaks;
      }
  const double mean_of_others = peaks > 1 ? (sum - 1) / (peaks - 1) : 0;  // the highest is 1
  const float weight = static_cast<float>((1 - mean_of_others) * (1 - mean_of_others));
  for (float& value : map) value *= weight;
}

}  // namespace saccade
