#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/setting.hpp"

namespace saccade {

/// A video mode of a sensor.
struct SensorMode {
  int width = 640, height = 480;  ///< px
  int rate_hz = 30;
  bool operator==(const SensorMode&) const = default;
};

/// "640x480@30"
std::string to_text(const SensorMode& mode);

/// How a live sensor is opened and used.
struct SensorSettings {
  std::optional<SensorMode> mode;  ///< none: 640x480@30, or the nearest mode of the device
  bool registration = true;        ///< depth as seen from the colour camera
  bool mirror = false;
  std::optional<int> exposure;  ///< in the device's own unit; none: automatic
  bool auto_white_balance = true;
  bool reconnect = true;  ///< wait for a device that was lost; false: its loss is an error
  double wait_s = 5;      ///< time to wait for a device that is not connected at the start
};

std::vector<SettingOf<SensorSettings>> sensor_setting_specs();

}  // namespace saccade
