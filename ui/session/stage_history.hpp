#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <vector>

#include "core/stage_times.hpp"

namespace saccade {

/// A duration now and over the frames that are remembered, in ms; 0 if there are none.
struct DurationSummary {
  double last_ms = 0, p50_ms = 0, p95_ms = 0;
};

/// The stage times and latencies of the last frames, for a panel that shows them. One thread at a time.
class StageHistory {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kStages = kStageNames.size();

  /// Remembers so many frames, >= 1; throws std::invalid_argument otherwise.
  explicit StageHistory(std::size_t capacity = 300);

  /// Adds a frame whose result was there at `at`, `latency_ms` after it was captured. `at` does not go back.
  void add(const StageTimes& times, double latency_ms, Clock::time_point at);
  void clear() { frames_.clear(); }
  std::size_t size() const { return frames_.size(); }
  std::size_t capacity() const { return capacity_; }

  DurationSummary stage(Stage stage) const;
  DurationSummary total() const;  ///< of all stages of a frame
  DurationSummary latency() const;

  /// Frames a second over the frames of the last 2 s before `now`; 0 if they are fewer than two.
  double rate_hz(Clock::time_point now) const;

  /// For a stacked plot: of each frame, oldest first, the sums of the stages up to and including each, in ms.
  using Stack = std::array<float, kStages>;
  std::vector<Stack> stacks() const;

 private:
  struct Timing {
    StageTimes stages;
    double latency_ms;
    Clock::time_point at;
  };
  template <typename Value>
  DurationSummary summary_of(const Value& value) const;

  std::size_t capacity_;
  std::deque<Timing> frames_;
};

}  // namespace saccade
