#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace saccade {

/// Times of frames that go on through losses of the device, from the device's clock and this machine's. The
/// first frame has the time 0. While the device is there its clock counts, because it is nearest to the
/// exposure; where it starts again, or jumps by more than a second against the machine's clock, the machine's
/// clock gives the time that has passed. Times always increase. Not thread-safe.
class StreamClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// The device was opened again: its clock may have restarted.
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
