#pragma once

#include <array>
#include <cstdint>

#include "core/stage_times.hpp"

namespace saccade {

/// A histogram of durations with bins that grow by 2 %: its memory is fixed, and percentiles are exact to 1
/// %.
class DurationHistogram {
 public:
  void add(double ms);

  std::int64_t count() const { return count_; }
  double mean_ms() const { return count_ ? sum_ms_ / static_cast<double>(count_) : 0; }
  double max_ms() const { return max_ms_; }

  /// The duration that the share `p` (0..1) of all does not exceed; 0 if there are none.
  double percentile_ms(double p) const;

 private:
  std::array<std::int64_t, 1100> bins_{};
  std::int64_t count_ = 0;
  double sum_ms_ = 0, max_ms_ = 0;
};

/// The durations of every stage over all frames.
class StageStatistics {
 public:
  void add(const StageTimes& times);
  const DurationHistogram& operator[](Stage stage) const { return stages_[static_cast<std::size_t>(stage)]; }

 private:
  std::array<DurationHistogram, kStageNames.size()> stages_;
};

}  // namespace saccade
