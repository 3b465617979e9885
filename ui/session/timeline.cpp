#include "ui/session/timeline.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr std::int64_t kMostFrames = 1 << 20;  // bounds the memory that a wrong count can take

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

std::int64_t frame_at(double x, double width, std::int64_t frames) {
  if (frames <= 0 || width <= 0) return 0;
  return std::clamp(static_cast<std::int64_t>(std::floor(x / width * static_cast<double>(frames))),
                    std::int64_t{0}, frames - 1);
}

double frame_x(std::int64_t index, double width, std::int64_t frames) {
  return frames <= 0 ? 0 : (static_cast<double>(index) + 0.5) * width / static_cast<double>(frames);
}

std::int64_t tick_step(double width, std::int64_t frames, double label_width) {
  if (frames <= 0 || width <= 0) return 1;
  const double least = label_width * static_cast<double>(frames) / width;
  for (std::int64_t power = 1;; power *= 10)
    for (const std::int64_t digit : {1, 2, 5})
      if (static_cast<double>(digit * power) >= least) return digit * power;
}

}  // namespace saccade
