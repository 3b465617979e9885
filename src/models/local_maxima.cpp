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

// By value: compilers make no vectors of std::max, which gives references.
constexpr float higher(float a, float b) { return a > b ? a : b; }

/// Number and sum of the peaks from kCounts on of a map with values in 0..1.
struct Peaks {
  constexpr static float kCounts = 0.1F;
  int count = 0;
  double sum = 0;

  void add(float peak) { count += 1, sum += static_cast<double>(peak); }
};

// The columns with two neighbours are decided without branches, so that compilers make vectors of it.
Peaks find_peaks(const cv::Mat1f& map) {
  Peaks peaks;
  const int last = map.cols - 1;
  const std::vector<float> outside(static_cast<std::size_t>(map.cols), -1.0F);
  std::vector<float> peak_values(static_cast<std::size_t>(map.cols));
  float* const found = peak_values.data();
  for (int r = 0; r < map.rows; ++r) {
    const float* here = map[r];
    const float* up = r > 0 ? map[r - 1] : outside.data();
    const float* down = r + 1 < map.rows ? map[r + 1] : outside.data();
    for (int c = 1; c < last; ++c) {
      const float before = higher(higher(higher(up[c - 1], up[c]), up[c + 1]), here[c - 1]);
      const float after = higher(higher(higher(down[c - 1], down[c]), down[c + 1]), here[c + 1]);
      const float peak = before < here[c] ? here[c] : 0;
      found[c] = after <= here[c] ? peak : 0;
    }
    for (const int c : {0, last}) found[c] = is_peak(map, r, c) ? here[c] : 0;
    for (int c = 0; c <= last; ++c)
      if (found[c] >= Peaks::kCounts) peaks.add(found[c]);
  }
  return peaks;
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
  double low = 0, high = 0;
  cv::minMaxLoc(map, &low, &high);
  const float bottom = static_cast<float>(low), range = static_cast<float>(high) - bottom;
  if (!(range >= kSameValue)) {
    map.setTo(0);
    return;
  }
  for (int r = 0; r < map.rows; ++r)
    for (float& value : row_of(map, r)) value = (value - bottom) / range;
  const Peaks peaks = find_peaks(map);
  const double mean_of_others =
      peaks.count > 1 ? (peaks.sum - 1) / (peaks.count - 1) : 0;  // the highest is 1
  const float weight = static_cast<float>((1 - mean_of_others) * (1 - mean_of_others));
  for (int r = 0; r < map.rows; ++r)
    for (float& value : row_of(map, r)) value *= weight;
}

}  // namespace saccade
