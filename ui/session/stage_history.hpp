#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <deque>
#include <vector>

#include "core/stage_times.hpp"

namespace saccade {

/// A duration in the last frame, and its percentiles over the remembered frames, in ms; 0 without frames.
struct DurationSummary {
  double last_ms = 0, p50_ms = 0, p95_ms = 0;
};

/// The stage times and latencies of the last frames. One thread at a time.
class StageHistory {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kStages = kStageNames.size();

  /// Remembers `capacity` >= 1 frames; throws std::invalid_argument for less.
  explicit StageHistory(std::size_t capacity = 300);

  /// Adds a frame whose result came at `at`, `latency_ms` after its capture. `at` does not go back.
  void add(const StageTimes& times, double latency_ms, Clock::time_point at);
  void clear() { frames_.clear(); }
  std::size_t size() const { return frames_.size(); }
  std::size_t capacity() const { return capacity_; }

  [[nodiscard]] DurationSummary stage(Stage stage) const;
  [[nodiscard]] DurationSummary total() const;  ///< of all stages of a frame
  [[nodiscard]] DurationSummary latency() const;

  /// Frames per second over the last 2 s before `now`; 0 if there are fewer than two.
  [[nodiscard]] double rate_hz(Clock::time_point now) const;

  /// For a stacked plot: for each frame, oldest first, the sums of the stages up to each stage, in ms.
  using Stack = std::array<float, kStages>;
  [[nodiscard]] std::vector<Stack> stacks() const;

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
