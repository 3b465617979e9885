#pragma once

#include <string>
#include <vector>

#include "core/sensor_settings.hpp"
#include "drivers/openni2/openni2_runtime.hpp"

namespace saccade {

/// A connected sensor, for lists that people choose from.
struct DeviceListing {
  DeviceIdentity identity;
  std::string source;  ///< what SOURCE names it: "openni2:URI"
  std::string driver;  ///< "PS1080", "SaccadeFreenect", ... as its URI and vendor tell; empty = not known
  /// What is known only of a device that can be opened, or that the caller has not asked for.
  std::string serial;                    ///< empty = not known
  std::vector<SensorMode> depth_modes;   ///< in a format that Saccade reads
  std::vector<SensorMode> colour_modes;  ///< likewise
  std::string problem;                   ///< why it could not be opened; empty = no problem
};

/// The sensors that are connected now; cheap, opens nothing, and may be called as often as one likes while
/// devices stream: new ones appear, lost ones go. Any thread. Throws Error if OpenNI2 does not start.
std::vector<DeviceListing> list_devices();

/// Opens the device for a moment to learn serial number and modes. Not for a device that streams. A device
/// that cannot be opened gets a `problem`. One thread at a time.
void look_into(DeviceListing& device);

}  // namespace saccade
