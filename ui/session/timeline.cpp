#include "ui/session/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saccade {
namespace {

constexpr std::int64_t kMostFrames = 1 << 20;  // bounds the memory that a wrong count can take
constexpr double kFewestVisible = 10, kZoomOfStep = 1.25;

}  // namespace

void Timeline::reset(std::int64_t frames) {
  entries_.assign(static_cast<std::size_t>(std::clamp<std::int64_t>(frames, 0, kMostFrames)), {});
}

void Timeline::add(std::int64_t index, float strength, bool current) {
  if (index < 0 || index >= kMostFrames) return;
  const auto place = static_cast<std::size_t>(index);
  if (place >= entries_.size()) entries_.resize(place + 1);
  entries_[place] = {true, strength, current};
}

void Timeline::age() {
  for (Entry& entry : entries_) entry.current = false;
}

float Timeline::largest() const {
  float current = 0, all = 0;
  for (const Entry& entry : entries_) {
    all = std::max(all, entry.strength);
    if (entry.current) current = std::max(current, entry.strength);
  }
  return current > 0 ? current : all;
}

VisibleFrames TimelineZoom::visible(std::int64_t frames) const {
  const auto all = static_cast<double>(frames);
  return zoomed() && visible_.count < all ? visible_ : VisibleFrames{0, all};
}

void TimelineZoom::zoom(double steps, double share, std::int64_t frames) {
  const VisibleFrames now = visible(frames);
  const auto all = static_cast<double>(frames);
  const double count =
      std::clamp(now.count * std::pow(kZoomOfStep, -steps), std::min(kFewestVisible, all), all);
  visible_ = {now.first + share * (now.count - count), count};
  keep_inside(frames);
}

void TimelineZoom::pan(double share, std::int64_t frames) {
  if (!zoomed()) return;
  visible_.first += share * visible_.count;
  keep_inside(frames);
}

void TimelineZoom::follow(std::int64_t index, std::int64_t frames) {
  const auto place = static_cast<double>(index);
  if (std::exchange(followed_, index) == index || !zoomed() ||
      (place >= visible_.first && place + 1 <= visible_.first + visible_.count))
    return;
  visible_.first = place;
  keep_inside(frames);
}

void TimelineZoom::keep_inside(std::int64_t frames) {
  const auto all = static_cast<double>(frames);
  if (visible_.count >= all) visible_ = {};
  visible_.first = std::clamp(visible_.first, 0.0, std::max(all - visible_.count, 0.0));
}

std::vector<TimelineBar> timeline_bars(const std::vector<Timeline::Entry>& entries,
                                       const VisibleFrames& visible, double width) {
  std::vector<TimelineBar> bars;
  if (visible.count <= 0 || width <= 0) return bars;
  const auto first = static_cast<std::size_t>(visible.first);
  const auto end =
      std::min(entries.size(), static_cast<std::size_t>(std::ceil(visible.first + visible.count)));
  for (std::size_t i = first; i < end; ++i) {
    if (!entries[i].seen) continue;
    const double x = frame_x(static_cast<std::int64_t>(i), width, visible);
    const TimelineBar bar{x, entries[i].strength, entries[i].current};
    if (bars.empty() || std::floor(bars.back().x) != std::floor(x))
      bars.push_back(bar);
    else if (std::pair(bar.current, bar.strength) > std::pair(bars.back().current, bars.back().strength))
      bars.back() = bar;
  }
  return bars;
}

std::int64_t frame_at(double x, double width, const VisibleFrames& visible) {
  if (visible.count <= 0 || width <= 0) return 0;
  const double last = std::ceil(visible.first + visible.count) - 1;
  const double place = std::floor(visible.first + x / width * visible.count);
  return static_cast<std::int64_t>(std::clamp(place, std::floor(visible.first), last));
}

double frame_x(std::int64_t index, double width, const VisibleFrames& visible) {
  if (visible.count <= 0) return 0;
  return (static_cast<double>(index) + 0.5 - visible.first) * width / visible.count;
}

std::int64_t tick_step(double width, const VisibleFrames& visible, double label_width) {
  if (visible.count <= 0 || width <= 0) return 1;
  const double least = label_width * visible.count / width;
  for (std::int64_t power = 1;; power *= 10)
    for (const std::int64_t digit : {1, 2, 5})
      if (static_cast<double>(digit * power) >= least) return digit * power;
}

}  // namespace saccade
