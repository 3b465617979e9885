#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace saccade {

/// A kind of USB device that belongs to a depth sensor.
struct UsbSensorKind {
  enum class Part {
    camera,       ///< the sensor itself
    companion,    ///< motor or audio of a Kinect, which is there even if the camera has no power
    unsupported,  ///< a sensor that no driver module here can use
  };
  std::uint16_t vendor = 0, product = 0;  ///< product 0 = any of the vendor
  const char* name = "";
  Part part = Part::camera;
  const char* module = "";  ///< the driver module that serves it, "PS1080"; empty = none here
  const char* advice = "";  ///< of an unsupported one: how to use it all the same
};

/// One that is plugged in, as the kernel shows it.
struct UsbSensor {
  enum class Access {
    granted,    ///< this user may open it
    root_only,  ///< this user is root; others may not
    denied,
    no_node,  ///< there is no device file
  };
  UsbSensorKind kind;
  std::uint16_t product = 0;
  std::string place;           ///< the kernel's name of the port, "1-1.2"
  double speed_mbps = 0;       ///< 480 = USB 2.0 high speed; 0 = unknown
  std::filesystem::path node;  ///< /dev/bus/usb/001/004
  std::string mode;            ///< of the node, "rw-rw----"; empty without one
  Access access = Access::no_node;
  std::filesystem::path rule;  ///< the udev rules file that names it; empty = none
  std::string kernel_driver;   ///< that has taken its first interface; empty = none
};

/// The sensors that are plugged in, from `sysfs` ("/sys" on a real machine) and, beside it, dev/bus/usb and
/// {etc,run,usr/lib,lib}/udev/rules.d. Unreadable files are no error: without USB the list is empty.
std::vector<UsbSensor> find_usb_sensors(const std::filesystem::path& sysfs);

}  // namespace saccade
