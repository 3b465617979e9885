#include "ui/session/stage_history.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace saccade {
namespace {

double total_ms(const StageTimes& times) {
  double sum = 0;
  for (std::size_t i = 0; i < StageHistory::kStages; ++i) sum += times[static_cast<Stage>(i)];
  return sum;
}

// The smallest value that a share `p` of all values does not exceed.
double percentile(std::vector<double>& values, double p) {
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(p * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

StageHistory::StageHistory(std::size_t capacity) : capacity_(capacity) {
  if (capacity < 1) throw std::invalid_argument("StageHistory: a capacity of at least 1 expected");
}

void StageHistory::add(const StageTimes& times, double latency_ms, Clock::time_point at) {
  if (frames_.size() == capacity_) frames_.pop_front();
  frames_.push_back({times, latency_ms, at});
}

template <typename Value>
DurationSummary StageHistory::summary_of(const Value& value) const {
  if (frames_.empty()) return {};
  std::vector<double> values;
  values.reserve(frames_.size());
  for (const Timing& frame : frames_) values.push_back(value(frame));
  const double last = values.back();
  return {last, percentile(values, 0.50), percentile(values, 0.95)};
}

DurationSummary StageHistory::stage(Stage stage) const {
  return summary_of([stage](const Timing& frame) { return frame.stages[stage]; });
}

DurationSummary StageHistory::total() const {
  return summary_of([](const Timing& frame) { return total_ms(frame.stages); });
}

DurationSummary StageHistory::latency() const {
  return summary_of([](const Timing& frame) { return frame.latency_ms; });
}

double StageHistory::rate_hz(Clock::time_point now) const {
  constexpr std::chrono::seconds kRecent{2};
  const auto first = std::find_if(frames_.begin(), frames_.end(),
                                  [&](const Timing& frame) { return now - frame.at <= kRecent; });
  const auto count = frames_.end() - first;
  if (count < 2) return 0;
  const double span_s = std::chrono::duration<double>(frames_.back().at - first->at).count();
  return span_s > 0 ? static_cast<double>(count - 1) / span_s : 0;
}

std::vector<StageHistory::Stack> StageHistory::stacks() const {
  std::vector<Stack> stacks;
  stacks.reserve(frames_.size());
  for (const Timing& frame : frames_) {
    Stack stack{};
    double sum = 0;
    for (std::size_t i = 0; i < kStages; ++i) {
      sum += frame.stages[static_cast<Stage>(i)];
      stack[i] = static_cast<float>(sum);
    }
    stacks.push_back(stack);
  }
  return stacks;
}

}  // namespace saccade
