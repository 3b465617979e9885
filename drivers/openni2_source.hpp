#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/settings.hpp"
#include "drivers/openni2_device.hpp"
#include "pipeline/frame_source.hpp"

namespace saccade {

/// A live sensor, through OpenNI2. `openni2` is the first one that is connected, `openni2:URI` a certain one.
///
/// Each depth frame is a frame; one whose memory is too short for its size is `rejected`. Its colour is the
/// colour frame whose device time is at most half a period away (16.7 ms at 30 Hz); a depth frame waits for
/// it until a later colour frame or the next depth frame comes, and then goes without.
///
/// A device is lost when OpenNI2 says so, when it reports an error, or when it is silent for 2 s (5 s after
/// it was opened). The source then closes it and tries to open it again, at growing intervals of 0.1 s to 2 s
/// and at once when a device appears; the read() that notices it and those that follow
/// give `timeout`. Frames are numbered on, and their
/// times go on by the clock of this machine, so that they show how long the device was away.
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

  struct TimedColour {
    cv::Mat3b image;
    std::optional<std::int64_t> time_us;  // of the device; empty = no image
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
  bool pending_is_ripe() const;
  const TimedColour* colour_of_pending() const;
  ReadResult deliver(Frame& frame);
  std::string reason_of_loss() const;
  void lose(const std::string& why);
  void came_back();
  std::int64_t continuous_time(std::int64_t device_us);
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
  std::optional<std::int64_t> clock_offset_us_;  // frame time - device time; empty after opening
  std::optional<Clock::time_point> first_frame_at_;
  std::int64_t next_time_us_ = 0;  // at least
  std::int64_t period_us_ = 0;     // of depth: the mode's, or the shortest that was seen
  std::optional<std::int64_t> last_depth_us_;
  cv::Mat1f depth_, pending_;  // being read; waiting for its colour
  std::optional<std::int64_t> pending_us_;
  std::array<TimedColour, 2> colours_;
  std::size_t newest_colour_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool interrupted_ = false;  // guarded by mutex_, as is all below
  SourceState state_;
  std::optional<Clock::time_point> away_since_;
  SensorValues values_, wanted_, requested_;
  std::vector<SensorMode> modes_;
};

}  // namespace saccade
