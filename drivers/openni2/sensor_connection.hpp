#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "core/sensor_settings.hpp"
#include "drivers/openni2/openni2_device.hpp"
#include "drivers/openni2/openni2_runtime.hpp"

namespace saccade {

/// The device of one source through its losses: opens it, notices when it is lost, opens it again at growing
/// intervals of 0.1 s to 2 s and at once when a device appears, and says how it is doing. A device is lost
/// when OpenNI2 says so, when it reports an error, or when it gives no depth for 2 s (5 s after it was
/// opened). Thread safety: the thread that reads frames, except state() and the SensorControls, which any
/// thread may call.
class SensorConnection final : public SensorControls {
 public:
  using Clock = std::chrono::steady_clock;

  /// Opens the device if it is there. `device` is OpenNI2's URI of it, or serial=NUMBER; empty = any device.
  /// Throws Error: (failed) OpenNI2
  /// does not start, (usage) the device lacks the mode in `settings`, (unreadable) as give_up().
  SensorConnection(std::string device, const SensorSettings& settings);
  ~SensorConnection() override;

  /// nullptr while no device is open.
  OpenNi2Device* device() const { return device_.get(); }

  /// "VENDOR NAME (URI)" of the last device that was open. There must have been one.
  std::string name() const;

  /// When it is worth trying again.
  Clock::time_point next_try() const { return next_try_; }

  /// Tries to open the device if that is due; true if it is open now. Throws Error: (usage) it lacks the
  /// mode; (unreadable) no device has come in settings.wait_s seconds. A device that was open once is waited
  /// for without limit.
  bool try_to_connect();

  /// Why the open device counts as lost; std::nullopt if it does not.
  std::optional<std::string> reason_of_loss() const;

  /// Closes the device. Throws Error (failed) if it is not to be waited for.
  void lose(const std::string& why);

  /// Applies the changes that were requested since the last call.
  void apply_requests();

  void note_depth();       ///< a depth frame arrived, usable or not
  void note_colourless();  ///< a frame went without the colour that the device has

  SourceState state() const;
  SensorValues values() const override;
  std::vector<SensorMode> modes() const override;
  void request(const SensorValues& wanted) override;

 private:
  void open_found();
  int choose(const std::vector<DeviceIdentity>& devices) const;
  void took_device();
  void give_up() const;
  Clock::time_point last_heard() const { return heard_since_opening_ ? last_depth_at_ : opened_at_; }
  void set_state(SourceState::Connection connection, const std::string& text, Clock::time_point since);

  const SensorSettings settings_;
  const std::string wanted_;
  OpenNi2Runtime& runtime_;
  const Clock::time_point wait_until_;
  std::unique_ptr<OpenNi2Device> device_;
  std::optional<DeviceIdentity> last_device_;
  std::optional<std::string> last_failure_;  // why the device that is there could not be opened
  std::int64_t trouble_ = 0, arrivals_ = 0;
  std::chrono::milliseconds back_off_;
  Clock::time_point next_try_, opened_at_, last_depth_at_;
  bool heard_since_opening_ = false;

  mutable std::mutex mutex_;  // guards all below
  SourceState state_;
  std::optional<Clock::time_point> away_since_;
  SensorValues values_, wanted_values_, requested_;
  std::vector<SensorMode> modes_;
};

}  // namespace saccade
