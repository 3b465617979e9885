#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "core/sensor_settings.hpp"
#include "drivers/openni2/frame_pairing.hpp"
#include "drivers/openni2/openni2_device.hpp"
#include "drivers/openni2/stream_clock.hpp"

namespace saccade {

/// A live sensor, through OpenNI2. `openni2` is the first one that is connected, `openni2:URI` a certain one.
///
/// Each depth frame is a frame; one whose memory is too short for its size is `rejected`. Its colour is of
/// the same moment, to half a period (FramePairing).
///
/// A device is lost when OpenNI2 says so, when it reports an error, or when it is silent for 2 s (5 s after
/// it was opened). The source then closes it and tries to open it again, at growing intervals of 0.1 s to 2 s
/// and at once when a device appears; the read() that notices it and those that follow
/// give `timeout`. Frames are numbered on, and their times go on (StreamClock), so that they show how long
/// the device was away.
///
/// A device that is not there at the start is waited for in read(); until it comes, info() tells what was
/// asked for (640x480@30 and a guessed camera unless the settings say otherwise).
class OpenNi2Source final : public FrameSource, private SensorControls {
 public:
  /// Throws Error: (usage) the device lacks the mode that was asked for; (unreadable) there is no device and
  /// none is to be waited for; (failed) OpenNI2 does not start.
  OpenNi2Source(const std::string& uri, const SensorSettings& settings);
  ~OpenNi2Source() override;

  const SourceInfo& info() const override { return info_; }

  /// Throws Error: (failed) the device is lost and is not to be waited for, or what comes back is of another
  /// size; (unreadable) no device has come in settings.wait_s seconds.
  ReadResult read(Frame& frame, std::chrono::milliseconds timeout) override;
  [[noreturn]] void seek(std::int64_t index) override;
  SourceState state() const override;
  SensorControls* controls() override { return this; }
  void interrupt() noexcept override;

 private:
  using Clock = std::chrono::steady_clock;

  struct BadFrame {
    std::int64_t time_us = 0;  // of the device
    std::string reason;
  };

  SensorValues values() const override;
  std::vector<SensorMode> modes() const override;
  void request(const SensorValues& wanted) override;

  void try_to_connect();
  void took_device();
  void check_size() const;
  void wait_for_device(Clock::time_point deadline);
  void give_up_waiting();
  std::optional<ReadResult> poll_device(Frame& frame, Clock::time_point deadline);
  std::optional<ReadResult> take_depth(Frame& frame);
  void take_colour();
  ReadResult reject(Frame& frame);
  ReadResult deliver(Frame& frame);
  std::string reason_of_loss() const;
  void lose(const std::string& why);
  void came_back();
  void set_state(SourceState::Connection connection, const std::string& text, Clock::time_point since);
  void apply_requests();

  const SensorSettings settings_;
  const std::string wanted_uri_;  // empty = any device
  SourceInfo info_;
  OpenNi2Runtime& runtime_;

  // The reading thread's.
  std::unique_ptr<OpenNi2Device> device_;
  std::optional<DeviceIdentity> last_device_;
  std::string last_failure_;  // why the device that is there could not be opened
  std::int64_t trouble_ = 0, arrivals_ = 0;
  Clock::time_point wait_until_, next_try_;
  std::chrono::milliseconds back_off_{};
  Clock::time_point opened_at_, last_frame_at_;
  bool frames_since_opening_ = false;
  std::int64_t next_index_ = 0;
  StreamClock clock_;
  FramePairing pairing_;
  cv::Mat1f depth_;  // being read, as is colour_
  cv::Mat3b colour_;
  std::optional<BadFrame> bad_frame_;  // told when those before it have been given

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool interrupted_ = false;  // guarded by mutex_, as is all below
  SourceState state_;
  std::optional<Clock::time_point> away_since_;
  SensorValues values_, wanted_, requested_;
  std::vector<SensorMode> modes_;
};

}  // namespace saccade
