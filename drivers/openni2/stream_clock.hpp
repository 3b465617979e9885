#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace saccade {

/// Makes times of frames that go on through losses of the device, out of the device's clock and this
/// machine's. The first frame has the time 0. While the device is there its clock counts, since it knows best
/// when a frame was taken; where it starts anew, or jumps by more than a second against the machine's clock,
/// the latter tells how much time has passed. Times always grow. Not thread-safe.
class StreamClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// The device was opened again: its clock may have started anew.
  void restart() { last_.reset(); }

  /// The time of a frame, us since the first: `device_us` is the device's own, `now` when it came.
  std::int64_t time_us(std::int64_t device_us, Clock::time_point now);

 private:
  struct Reading {
    std::int64_t device_us = 0;
    Clock::time_point machine;
  };
  bool goes_on(std::int64_t device_us, Clock::time_point now) const;

  std::optional<Clock::time_point> first_;
  std::optional<Reading> last_;
  std::int64_t offset_us_ = 0;  // frame time - device time
  std::int64_t least_us_ = 0;   // of the next time
};

}  // namespace saccade
