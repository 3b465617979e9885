#include "app/devices_command.hpp"

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/standard_output.hpp"
#include "drivers/openni2/openni2_devices.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> texts_of(const std::vector<SensorMode>& modes) {
  std::vector<std::string> texts;
  texts.reserve(modes.size());
  for (const SensorMode& mode : modes) texts.push_back(to_text(mode));
  return texts;
}

std::string usb_id(const DeviceIdentity& device) {
  if (device.usb_vendor == 0) return "";
  return fmt::format("{:04x}:{:04x}", device.usb_vendor, device.usb_product);
}

Json to_json(const DeviceListing& device) {
  Json json = {{"name", device.identity.name},
               {"vendor", device.identity.vendor},
               {"uri", device.identity.uri},
               {"source", device.source},
               {"driver", device.driver},
               {"usb_id", usb_id(device.identity)},
               {"serial", device.serial},
               {"depth_modes", texts_of(device.depth_modes)},
               {"colour_modes", texts_of(device.colour_modes)}};
  if (!device.problem.empty()) json["problem"] = device.problem;
  return json;
}

std::string to_text(const DeviceListing& device) {
  std::string lines =
      fmt::format("{} {}\n  source  {}\n", device.identity.vendor, device.identity.name, device.source);
  const auto line = [&](const char* what, const std::string& text) {
    if (!text.empty()) lines += fmt::format("  {:<7} {}\n", what, text);
  };
  line("driver", device.driver);
  line("USB", usb_id(device.identity));
  line("serial", device.serial);
  line("depth", fmt::format("{}", fmt::join(texts_of(device.depth_modes), ", ")));
  line("colour", fmt::format("{}", fmt::join(texts_of(device.colour_modes), ", ")));
  line("problem", device.problem);
  return lines;
}

}  // namespace

void devices(bool json) {
  auto list = list_devices();
  for (DeviceListing& device : list) look_into(device);
  if (json) {
    Json array = Json::array();
    for (const DeviceListing& device : list) array.push_back(to_json(device));
    print_json(Json{{"devices", array}}, 2);
    return;
  }
  if (list.empty()) print_text("no sensor is connected; to find the reason, run saccade doctor\n");
  for (const DeviceListing& device : list) print_text(to_text(device));
}

void add_devices_command(CLI::App& app, std::function<void()>& action) {
  CLI::App& command = *app.add_subcommand("devices", "list the connected sensors and their drivers");
  const auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "print JSON on standard output");
  command.callback([json, &action] { action = [json] { devices(*json); }; });
}

}  // namespace saccade
