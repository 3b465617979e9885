#pragma once

#include <optional>
#include <vector>

#include "core/sensor_settings.hpp"

namespace saccade {

/// The settings of a sensor that can change while it streams. Empty: the device does not have the setting.
struct SensorValues {
  std::optional<bool> registration;  ///< depth as seen from the colour camera
  std::optional<bool> mirror;
  std::optional<bool> auto_exposure;
  std::optional<int> exposure;  ///< in the device's own unit; applies while auto_exposure is off
  std::optional<bool> auto_white_balance;

  bool operator==(const SensorValues&) const = default;
};

/// The controls of an open sensor. Any thread.
class SensorControls {
 public:
  virtual ~SensorControls() = default;

  /// As read back from the device after the last change, not as requested. All empty while no device is open.
  virtual SensorValues values() const = 0;

  /// The depth modes of the device, each once, for SensorSettings::mode of the next opening: an open source
  /// keeps its mode. Empty until a device has been opened; kept while it is lost.
  virtual std::vector<SensorMode> modes() const = 0;

  /// Requests the values in `wanted` that are not empty. The thread that reads frames applies them before its
  /// next frame; values() then has the result. They also apply to a device that reconnects.
  virtual void request(const SensorValues& wanted) = 0;
};

}  // namespace saccade
