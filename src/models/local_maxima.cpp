#include "models/local_maxima.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace saccade {
namespace {

std::span<float> row_of(cv::Mat1f& map, int row) { return {map[row], static_cast<std::size_t>(map.cols)}; }

// Whether no neighbour is higher and none before it in reading order as high: a plateau counts about once.
bool is_peak(const cv::Mat1f& map, int row, int col) {
  const float value = map(row, col);
  const int first = std::max(0, col - 1), last = std::min(map.cols - 1, col + 1);
  const float* here = map[row];
  if (col > 0 && here[first] >= value) return false;  // most pixels of a slope end here or in the next line
  if (here[last] > value) return false;
  if (row > 0)
    for (int c = first; c <= last; ++c)
      if (map(row - 1, c) >= value) return false;
  if (row + 1 < map.rows)
    for (int c = first; c <= last; ++c)
      if (map(row + 1, c) > value) return false;
  return true;
}

}  // namespace

void attenuate_border(cv::Mat1f& map) {
  const int border = (std::max(map.rows, map.cols) + 10) / 20;
  const auto share = [&](int i, int n) {
    return static_cast<float>(std::min({i + 1, n - i, border + 1})) / static_cast<float>(border + 1);
  };
  std::vector<float> across(static_cast<std::size_t>(map.cols));
  for (int c = 0; c < map.cols; ++c) across[static_cast<std::size_t>(c)] = share(c, map.cols);
  for (int r = 0; r < map.rows; ++r) {
    const float down = share(r, map.rows);
    float* row = map[r];
    for (std::size_t c = 0; c < across.size(); ++c) row[c] *= down * across[c];
  }
}

void promote_few_peaks(cv::Mat1f& map) {
  constexpr float kCounts = 0.1F;
  double low = 0, high = 0;
  cv::minMaxLoc(map, &low, &high);
  const float bottom = static_cast<float>(low), range = static_cast<float>(high) - bottom;
  if (!(range >= kSameValue)) {
    map.setTo(0);
    return;
  }
  for (int r = 0; r < map.rows; ++r)
    for (float& value : row_of(map, r)) value = (value - bottom) / range;
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
  for (int r = 0; r < map.rows; ++r)
    for (float& value : row_of(map, r)) value *= weight;
}

}  // namespace saccade
