#include "models/local_maxima.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace saccade {
namespace {

std::span<float> row_of(cv::Mat1f& map, int row) { return {map[row], static_cast<std::size_t>(map.cols)}; }

// By value: compilers make no vectors of std::max, which gives references.
constexpr float higher(float a, float b) { return a > b ? a : b; }

/// Number and sum of the peaks from kCounts on of a map with values in 0..1.
struct Peaks {
  constexpr static float kCounts = 0.1F;
  int count = 0;
  double sum = 0;

  void add(float peak) { count += 1, sum += static_cast<double>(peak); }
};

// A peak is a pixel that no neighbour exceeds and none before it in reading order equals: a plateau counts
// about once. Without branches, so that compilers make vectors of it.
Peaks find_peaks(const cv::Mat1f& map) {
  constexpr int kRim = 1;
  cv::Mat1f padded;
  cv::copyMakeBorder(map, padded, kRim, kRim, kRim, kRim, cv::BORDER_CONSTANT, cv::Scalar(-1));  // below all
  std::vector<float> peak_values(static_cast<std::size_t>(map.cols));
  float* const found = peak_values.data();
  Peaks peaks;
  for (int r = 0; r < map.rows; ++r) {
    const float *up = padded[r] + kRim, *here = padded[r + 1] + kRim, *down = padded[r + 2] + kRim;
    for (int c = 0; c < map.cols; ++c) {
      const float before = higher(higher(higher(up[c - 1], up[c]), up[c + 1]), here[c - 1]);
      const float after = higher(higher(higher(down[c - 1], down[c]), down[c + 1]), here[c + 1]);
      const float peak = before < here[c] ? here[c] : 0;
      found[c] = after <= here[c] ? peak : 0;
    }
    for (int c = 0; c < map.cols; ++c)
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
