#include "pipeline/stage_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr double kSmallest_ms = 1e-3, kGrowth = 1.02;  // 1100 bins reach to 1e-3 * 1.02^1100 ms = 48 minutes

}  // namespace

void DurationHistogram::add(double ms) {
  const double bin = ms > kSmallest_ms ? std::log(ms / kSmallest_ms) / std::log(kGrowth) : 0;
  ++bins_[std::min(static_cast<std::size_t>(bin), bins_.size() - 1)];
  ++count_;
  sum_ms_ += ms;
  max_ms_ = std::max(max_ms_, ms);
}

double DurationHistogram::percentile_ms(double p) const {
  if (count_ == 0) return 0;
  const auto rank = static_cast<std::int64_t>(std::ceil(p * static_cast<double>(count_)));
  std::int64_t seen = 0;
  std::size_t bin = 0;
  while (bin + 1 < bins_.size() && (seen += bins_[bin]) < std::max<std::int64_t>(rank, 1)) ++bin;
  return std::min(max_ms_, kSmallest_ms * std::pow(kGrowth, static_cast<double>(bin) + 0.5));
}

void StageStatistics::add(const StageTimes& times) {
  for (std::size_t i = 0; i < stages_.size(); ++i) stages_[i].add(times[static_cast<Stage>(i)]);
}

}  // namespace saccade
