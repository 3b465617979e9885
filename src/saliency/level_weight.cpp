#include "saliency/level_weight.hpp"

#include <algorithm>

namespace saccade {
namespace {

float maximum_of(const LevelPlanes& level) {
  float maximum = 0;
  for (int r = 0; r < level.height(); ++r) {
    const float* row = level.row(LevelPlanes::kScore, r);
    maximum = std::max(maximum, *std::max_element(row, row + level.width()));
  }
  return maximum;
}

// Whether no neighbour of a pixel inside the border is higher.
bool is_peak(const LevelPlanes& level, int row, int col) {
  const float* at = level.row(LevelPlanes::kScore, row) + col;
  for (int v = -1; v <= 1; ++v)
    for (int u = -1; u <= 1; ++u)
      if (at[v * level.stride() + u] > *at) return false;
  return true;
}

double itti_weight(const LevelPlanes& level, double maximum) {
  double sum = 0;
  int count = 0;
  bool highest_seen = false;  // one highest peak is left out, others as high are not
  for (int r = 1; r + 1 < level.height(); ++r)
    for (int c = 1; c + 1 < level.width(); ++c) {
      const double value = static_cast<double>(level.row(LevelPlanes::kScore, r)[c]);
      if (value <= 0 || !is_peak(level, r, c)) continue;
      if (value == maximum && !highest_seen) {
        highest_seen = true;
        continue;
      }
      sum += value / maximum;
      ++count;
    }
  const double mean = count ? sum / count : 0;
  return (1 - mean) * (1 - mean) / maximum;
}

}  // namespace

float level_weight(const LevelPlanes& level, LevelNormalisation kind) {
  if (kind == LevelNormalisation::none) return 1;
  const double maximum = static_cast<double>(maximum_of(level));
  if (maximum <= 0) return 1;
  return static_cast<float>(kind == LevelNormalisation::max ? 1 / maximum : itti_weight(level, maximum));
}

}  // namespace saccade
