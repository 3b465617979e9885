#include "app/doctor.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

using Part = UsbSensorKind::Part;
using Access = UsbSensor::Access;

constexpr double kHighSpeed_mbps = 480;

std::string title(const UsbSensor& sensor) {
  return fmt::format("{} ({:04x}:{:04x}, port {})", sensor.kind.name, sensor.kind.vendor, sensor.product,
                     sensor.place);
}

std::string access_remedy(const UsbSensor& sensor) {
  const std::string apply = "sudo udevadm control --reload && sudo udevadm trigger --subsystem-match=usb";
  if (sensor.rule.empty())
    return fmt::format(
        "echo 'SUBSYSTEM==\"usb\", ATTR{{idVendor}}==\"{:04x}\", ATTR{{idProduct}}==\"{:04x}\", "
        "MODE=\"0666\"' | "
        "sudo tee -a /etc/udev/rules.d/61-saccade.rules && {}",
        sensor.kind.vendor, sensor.product, apply);
  if (sensor.mode.size() == 9 && sensor.mode.substr(3, 2) == "rw")
    return fmt::format("sudo usermod -aG $(stat -c %G {}) $USER, then log in again", sensor.node.string());
  return apply + ", then plug it in again";
}

bool left_out(const Examination& found, std::string_view module) {
  return std::ranges::count(found.openni2.left_out, module) > 0;
}

void check_openni2(const Examination& found, std::vector<Problem>& problems) {
  if (!found.openni2.in_this_build) {
    problems.push_back({found.openni2_error, "configure with -DSACCADE_OPENNI2=ON and build again"});
    return;
  }
  const std::string reinstall = "sudo apt-get install --reinstall libopenni2-0";
  if (!found.openni2_error.empty()) problems.push_back({found.openni2_error, reinstall});
  for (const std::string_view name : kOwnModules)
    if (!left_out(found, name) && found.openni2.module(name) == nullptr)
      problems.push_back(
          {fmt::format("our driver module {} is not in {}", name, found.openni2.driver_folder.string()),
           "install saccade again, or build it again with all of its targets"});
  for (const char* name : {"PS1080", "PSLink"})
    if (found.openni2.module(name) == nullptr)
      problems.push_back({fmt::format("the driver module {} of OpenNI2 is not in {}", name,
                                      found.openni2.driver_folder.string()),
                          reinstall});
  for (const auto& module : found.openni2.modules)
    if (!module.problem.empty())
      problems.push_back(
          {fmt::format("the driver module {} cannot be loaded: {}", module.name, module.problem),
           fmt::format("ldd {}", module.path.string())});
}

void check_sensor(const UsbSensor& sensor, const Examination& found, std::vector<Problem>& problems) {
  if (sensor.kind.part == Part::companion) return;  // motor and audio are slow, and not used
  const std::string name = title(sensor);
  if (found.openni2.in_this_build && left_out(found, sensor.kind.module)) {
    problems.push_back({name + ": this build has no driver module for it",
                        "configure with -DSACCADE_FREENECT=ON and build again"});
    return;
  }
  if (sensor.kind.part == Part::unsupported) {
    problems.push_back({name + ": there is no driver module for it",
                        "copy its maker's OpenNI2 module into the driver folder"});
    return;
  }
  if (sensor.access == Access::no_node)
    problems.push_back(
        {fmt::format("{}: there is no device file {}", name, sensor.node.string()),
         "sudo udevadm trigger --subsystem-match=usb, or pass /dev/bus/usb into the container"});
  if (sensor.access == Access::denied || sensor.access == Access::root_only)
    problems.push_back(
        {fmt::format(
             "{}: {} {} ({}), {}", name,
             sensor.access == Access::denied ? "no permission for" : "only root has permission for",
             sensor.node.string(), sensor.mode,
             sensor.rule.empty() ? "no udev rule names it" : "though " + sensor.rule.string() + " names it"),
         access_remedy(sensor)});
  if (sensor.speed_mbps > 0 && sensor.speed_mbps < kHighSpeed_mbps)
    problems.push_back(
        {fmt::format("{}: connected at {:g} Mb/s, too slow for images", name, sensor.speed_mbps),
         "plug it into a USB 2.0 or 3.0 port without a hub; lsusb -t shows the speeds"});
  if (sensor.kernel_driver.starts_with("gspca"))
    problems.push_back({fmt::format("{}: the kernel's webcam driver {} uses it", name, sensor.kernel_driver),
                        fmt::format("sudo modprobe -r {}", sensor.kernel_driver)});
}

bool has(const std::vector<UsbSensor>& sensors, Part part) {
  return std::any_of(sensors.begin(), sensors.end(), [&](const auto& s) { return s.kind.part == part; });
}

}  // namespace

Examination examine(const std::string& sysfs) {
  Examination found;
  found.openni2 = find_openni2();
  found.usb = find_usb_sensors(sysfs);
  try {
    found.devices = list_devices();
  } catch (const Error& error) {
    found.openni2_error = error.what();
  }
  return found;
}

std::vector<Problem> diagnose(const Examination& found) {
  std::vector<Problem> problems;
  check_openni2(found, problems);
  for (const UsbSensor& sensor : found.usb) check_sensor(sensor, found, problems);
  const bool camera = has(found.usb, Part::camera);
  if (!camera && has(found.usb, Part::companion))
    problems.push_back({"a Kinect is connected, but its camera is missing: it has no power",
                        "connect the Kinect's own power supply"});
  if (found.usb.empty() && found.devices.empty())
    problems.push_back({"no USB device looks like a sensor", "plug one in, then check with lsusb"});
  if (camera && found.devices.empty() && problems.empty())
    problems.push_back({"OpenNI2 does not list the sensor that is connected",
                        "quit other programs that use it, then plug it in again"});
  return problems;
}

}  // namespace saccade
