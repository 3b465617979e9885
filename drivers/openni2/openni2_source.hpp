#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "core/frame_source.hpp"
#include "core/sensor_settings.hpp"
#include "drivers/openni2/frame_pairing.hpp"
#include "drivers/openni2/sensor_connection.hpp"
#include "drivers/openni2/stream_clock.hpp"

namespace saccade {

/// A live sensor, through OpenNI2: `openni2` is the first one that is connected, `openni2:URI` and
/// `openni2:serial=NUMBER` name one.
///
/// Each depth frame is a frame; one whose memory is too short for its size is `rejected`. Its colour is of
/// the same moment, to half a period (FramePairing).
///
/// When the device is lost (SensorConnection), the read() that notices it and those that follow give
/// `timeout`, until it is back. Frames are numbered on, and their times go on (StreamClock), so that they
/// show how long the device was away.
///
/// read() also waits for a device that is not there at the start; until it comes, info() holds what was asked
/// for (640x480@30 and a guessed camera unless the settings say otherwise).
class OpenNi2Source final : public FrameSource {
 public:
  /// Throws Error: (usage) the device lacks the mode that was asked for; (unreadable) there is no device, and
  /// Saccade is not to wait for one; (failed) OpenNI2 does not start.
  OpenNi2Source(const std::string& uri, const SensorSettings& settings);

  const SourceInfo& info() const override { return info_; }

  /// Throws Error: (failed) the device is lost and is not to be waited for, or comes back with another size;
  /// (unreadable) no device has come in settings.wait_s seconds.
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override;
  [[noreturn]] void seek(std::int64_t index) override;
  SourceState state() const override { return connection_.state(); }
  SensorControls* controls() override { return &connection_; }
  void interrupt() noexcept override;

 private:
  using Clock = std::chrono::steady_clock;

  struct BadFrame {
    std::int64_t time_us = 0;  // of the device
    std::string reason;
  };

  bool take_interrupt();
  void wait_for_device(Clock::time_point deadline);
  void check_size() const;
  void restart_streams();
  std::optional<ReadResult> poll_device(Frame& frame, Clock::time_point deadline);
  std::optional<ReadResult> take_depth(Frame& frame);
  void take_colour();
  ReadResult reject(Frame& frame);
  ReadResult deliver(Frame& frame);

  SensorConnection connection_;
  SourceInfo info_;
  std::int64_t next_index_ = 0;
  StreamClock clock_;
  FramePairing pairing_;
  cv::Mat1f depth_;  // being read, as is colour_
  cv::Mat3b colour_;
  std::optional<BadFrame> bad_frame_;  // reported after the frames before it

  std::mutex mutex_;
  std::condition_variable wake_;
  bool interrupted_ = false;  // guarded by mutex_
};

}  // namespace saccade
