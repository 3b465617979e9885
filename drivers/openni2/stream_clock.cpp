#include "drivers/openni2/stream_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace saccade {
namespace {

constexpr std::int64_t kJump_us = 1'000'000;

std::int64_t microseconds(StreamClock::Clock::duration time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time).count();
}

}  // namespace

bool StreamClock::goes_on(std::int64_t device_us, Clock::time_point now) const {
  if (!last_) return false;
  const std::int64_t step_us = device_us - last_->device_us;
  return std::abs(step_us - microseconds(now - last_->machine)) <= kJump_us;
}

std::int64_t StreamClock::time_us(std::int64_t device_us, Clock::time_point now) {
  if (!first_) first_ = now;
  if (!goes_on(device_us, now)) offset_us_ = std::max(microseconds(now - *first_), least_us_) - device_us;
  last_ = {device_us, now};
  const std::int64_t time_us = std::max(device_us + offset_us_, least_us_);
  least_us_ = time_us + 1;
  return time_us;
}

}  // namespace saccade
