#pragma once

#include <string>
#include <vector>

#include "drivers/openni2/openni2_devices.hpp"
#include "drivers/openni2/openni2_installation.hpp"
#include "drivers/openni2/usb_sensors.hpp"

namespace saccade {

/// Something that prevents a sensor from being found or used, and its remedy.
struct Problem {
  std::string what;    ///< one line
  std::string remedy;  ///< a command, or an instruction
};

/// The facts about this machine from which diagnose() works.
struct Examination {
  OpenNi2Installation openni2;
  std::vector<UsbSensor> usb;
  std::vector<DeviceListing> devices;  ///< as OpenNI2 lists them
  std::string openni2_error;           ///< reason why it does not start; empty = it starts
};

/// Looks at this machine, with its sysfs in that folder ("/sys").
[[nodiscard]] Examination examine(const std::string& sysfs);

/// The problems in their order of importance; empty if a sensor is ready for use.
[[nodiscard]] std::vector<Problem> diagnose(const Examination& found);

}  // namespace saccade
