#pragma once

#include <string>
#include <vector>

#include "core/sensor_settings.hpp"
#include "drivers/openni2/openni2_runtime.hpp"

namespace saccade {

/// A connected sensor, for lists from which a user chooses.
struct DeviceListing {
  DeviceIdentity identity;
  std::string source;  ///< its name as a SOURCE: "openni2:URI"
  std::string driver;  ///< "PS1080", "SaccadeFreenect", ... from its URI and vendor; empty = not known. Of
                       ///< another maker's module: its file, after look_into()
  /// The rest is known after look_into().
  std::string serial;                    ///< empty = not known
  std::vector<SensorMode> depth_modes;   ///< in a format that Saccade reads
  std::vector<SensorMode> colour_modes;  ///< likewise
  std::string problem;                   ///< why it could not be opened; empty = no problem
};

/// The sensors that are connected now. Cheap: opens nothing, and may be called repeatedly while devices
/// stream. Any thread. Throws Error if OpenNI2 does not start, or (usage) is not in this build.
std::vector<DeviceListing> list_devices();

/// Opens the device for a moment to read its serial number; empty = it has none, or cannot be opened. Any
/// thread.
[[nodiscard]] std::string serial_of(const DeviceIdentity& device);

/// Opens the device for a moment to read its serial number and modes, and which module it comes from. Not for
/// a device that streams. A device that cannot be opened gets a `problem`. One thread at a time.
void look_into(DeviceListing& device);

}  // namespace saccade
