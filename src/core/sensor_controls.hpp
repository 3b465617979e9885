#pragma once

#include <optional>
#include <vector>

#include "core/sensor_settings.hpp"

namespace saccade {

/// What a sensor can change while it streams. Empty: the device does not have it.
struct SensorValues {
  std::optional<bool> registration;  ///< depth as seen from the colour camera
  std::optional<bool> mirror;
  std::optional<bool> auto_exposure;
  std::optional<int> exposure;  ///< the device's own unit; the device obeys it while auto_exposure is off
  std::optional<bool> auto_white_balance;

  bool operator==(const SensorValues&) const = default;
};

/// The controls of an open sensor, for people to turn. Any thread.
class SensorControls {
 public:
  virtual ~SensorControls() = default;

  /// As read back from the device when it was last set, not as asked for. All empty while no device is there.
  virtual SensorValues values() const = 0;

  /// The modes in which the device can give depth, each once, for SensorSettings::mode of the next opening: a
  /// source that is open keeps its own. Empty until a device has been opened; stays while it is lost.
  virtual std::vector<SensorMode> modes() const = 0;

  /// Asks for what is not empty in `wanted`. Done by the thread that reads frames, before its next frame;
  /// values() then says what has become of it. Holds for a device that comes back, too.
  virtual void request(const SensorValues& wanted) = 0;
};

}  // namespace saccade
