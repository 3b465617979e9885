#include "app/doctor_command.hpp"

#include <iterator>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/doctor.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

const char* to_text(UsbSensor::Access access) {
  switch (access) {
    case UsbSensor::Access::granted:
      return "granted";
    case UsbSensor::Access::root_only:
      return "root only";
    case UsbSensor::Access::denied:
      return "denied";
    case UsbSensor::Access::no_node:
      break;
  }
  return "no device file";
}

Json usb_json(const UsbSensor& sensor) {
  return {{"name", sensor.kind.name},
          {"usb_id", fmt::format("{:04x}:{:04x}", sensor.kind.vendor, sensor.product)},
          {"port", sensor.place},
          {"speed_mbps", sensor.speed_mbps},
          {"node", sensor.node.string()},
          {"mode", sensor.mode},
          {"permission", to_text(sensor.access)},
          {"udev_rule", sensor.rule.string()},
          {"kernel_driver", sensor.kernel_driver},
          {"module", sensor.kind.module}};
}

Json to_json(const Examination& found, const std::vector<Problem>& problems) {
  Json modules = Json::array(), usb = Json::array(), devices = Json::array(), list = Json::array();
  for (const auto& module : found.openni2.modules)
    modules.push_back({{"name", module.name},
                       {"path", module.path.string()},
                       {"named", module.named},
                       {"problem", module.problem}});
  for (const UsbSensor& sensor : found.usb) usb.push_back(usb_json(sensor));
  for (const DeviceListing& device : found.devices)
    devices.push_back({{"name", device.identity.name},
                       {"vendor", device.identity.vendor},
                       {"source", device.source},
                       {"driver", device.driver}});
  for (const Problem& problem : problems)
    list.push_back({{"problem", problem.what}, {"remedy", problem.remedy}});
  return {{"ok", problems.empty()},
          {"openni2",
           {{"in_this_build", found.openni2.in_this_build},
            {"library", found.openni2.library.string()},
            {"version", found.openni2.version},
            {"driver_folder", found.openni2.driver_folder.string()},
            {"redirected_by", found.openni2.redirected_by.string()},
            {"modules", modules}}},
          {"usb", usb},
          {"devices", devices},
          {"problems", list}};
}

std::string to_text(const Examination& found, const std::vector<Problem>& problems) {
  std::string text;
  const auto add = std::back_inserter(text);
  if (found.openni2.in_this_build) {
    fmt::format_to(add, "OpenNI2   {} ({})\n", found.openni2.version, found.openni2.library.string());
    fmt::format_to(add, "drivers   in {}{}\n", found.openni2.driver_folder.string(),
                   found.openni2.redirected_by.empty() ? "" : ", as OpenNI.ini says");
  } else {
    fmt::format_to(add, "OpenNI2   not in this build\n");
  }
  for (const auto& module : found.openni2.modules)
    fmt::format_to(add, "          {}{}{}\n", module.name,
                   module.named ? " (" + module.path.string() + ")" : "",
                   module.problem.empty() ? "" : ": " + module.problem);
  if (found.usb.empty()) fmt::format_to(add, "USB       no sensor\n");
  for (const UsbSensor& sensor : found.usb)
    fmt::format_to(add, "USB       {} {:04x}:{:04x}, port {}, {}, {} {}: {}; udev rule: {}\n",
                   sensor.kind.name, sensor.kind.vendor, sensor.product, sensor.place,
                   sensor.speed_mbps > 0 ? fmt::format("{:g} Mb/s", sensor.speed_mbps) : "speed unknown",
                   sensor.node.string(), sensor.mode, to_text(sensor.access),
                   sensor.rule.empty() ? "none" : sensor.rule.string());
  for (const DeviceListing& device : found.devices)
    fmt::format_to(add, "sensor    {} {}: {}\n", device.identity.vendor, device.identity.name, device.source);
  for (const Problem& problem : problems)
    fmt::format_to(add, "PROBLEM   {} -> {}\n", problem.what, problem.remedy);
  if (problems.empty()) fmt::format_to(add, "no problems: try saccade view openni2\n");
  return text;
}

}  // namespace

void doctor(const DoctorArguments& arguments) {
  const Examination found = examine(arguments.sysfs);
  const auto problems = diagnose(found);
  if (arguments.json)
    print_json(to_json(found, problems), 2);
  else
    print_text(to_text(found, problems));
}

void add_doctor_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command =
      *app.add_subcommand("doctor", "find out why a sensor is not found: library, drivers, udev rule, USB");
  const auto arguments = std::make_shared<DoctorArguments>();
  command.add_flag("--json", arguments->json, "print JSON on standard output");
  command.add_option("--sysfs", arguments->sysfs, "folder of sysfs, with dev and lib/udev beside it [/sys]")
      ->type_name("DIR");
  command.callback([arguments, &action] { action = [arguments] { doctor(*arguments); }; });
}

}  // namespace saccade
