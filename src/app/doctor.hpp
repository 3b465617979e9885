#pragma once

#include <string>
#include <vector>

#include "drivers/openni2/openni2_devices.hpp"
#include "drivers/openni2/openni2_installation.hpp"
#include "drivers/openni2/usb_sensors.hpp"

namespace saccade {

/// Something that keeps a sensor from being found or used, and what mends it.
struct Problem {
  std::string what;    ///< one line
  std::string remedy;  ///< a command, or what to do by hand
};

/// All that matters for finding a sensor.
struct Examination {
  OpenNi2Installation openni2;
  std::vector<UsbSensor> usb;
  std::vector<DeviceListing> devices;  ///< as OpenNI2 lists them
  std::string openni2_error;           ///< why it does not start; empty = it does
};

/// The problems in their order of importance; empty if a sensor is ready for use.
std::vector<Problem> diagnose(const Examination& found);

}  // namespace saccade
