#include "drivers/openni2/usb_sensors.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include <fmt/format.h>

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Part = UsbSensorKind::Part;

constexpr UsbSensorKind kKinds[] = {
    {0x1d27, 0x0600, "Asus Xtion Pro or PrimeSense sensor", Part::camera, "PS1080"},
    {0x1d27, 0x0601, "Asus Xtion Pro Live or PrimeSense sensor", Part::camera, "PS1080"},
    {0x1d27, 0x0609, "Asus Xtion 2 or PrimeSense sensor", Part::camera, "PS1080"},
    {0x1d27, 0x1250, "PrimeSense Capri sensor", Part::camera, "PSLink"},
    {0x1d27, 0x1260, "PrimeSense Capri sensor", Part::camera, "PSLink"},
    {0x1d27, 0x1270, "PrimeSense Capri sensor", Part::camera, "PSLink"},
    {0x1d27, 0x1280, "PrimeSense Capri sensor", Part::camera, "PSLink"},
    {0x1d27, 0x1290, "PrimeSense Capri sensor", Part::camera, "PSLink"},
    {0x1d27, 0x0000, "PrimeSense device", Part::camera, "PS1080"},
    {0x045e, 0x02ae, "Kinect for Xbox 360, camera", Part::camera, "SaccadeFreenect"},
    {0x045e, 0x02bf, "Kinect for Windows, camera", Part::camera, "SaccadeFreenect"},
    {0x045e, 0x02b0, "Kinect for Xbox 360, motor", Part::companion, ""},
    {0x045e, 0x02ad, "Kinect for Xbox 360, audio", Part::companion, ""},
    {0x045e, 0x02be, "Kinect for Windows, audio", Part::companion, ""},
    {0x045e, 0x02c2, "Kinect for Windows, hub", Part::companion, ""},
    {0x045e, 0x02c4, "Kinect v2", Part::unsupported, ""},
    {0x045e, 0x02d8, "Kinect v2", Part::unsupported, ""},
    {0x045e, 0x097c, "Azure Kinect", Part::unsupported, ""},
    {0x0b05, 0x1a26, "Asus Xtion 2", Part::unsupported, ""},
    {0x2bc5, 0x0000, "Orbbec sensor", Part::unsupported, ""},
    {0x2959, 0x0000, "Structure sensor of Occipital", Part::unsupported, ""},
    {0x8086, 0x0aa5, "Intel RealSense", Part::unsupported, ""},
};

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

template <typename Number>
std::optional<Number> read_number(const fs::path& path, int base = 10) {
  const std::string text = first_line(path);
  Number value{};
  const auto end = text.data() + text.size();
  if constexpr (std::is_integral_v<Number>) {
    if (std::from_chars(text.data(), end, value, base).ec != std::errc()) return std::nullopt;
  } else {
    if (std::from_chars(text.data(), end, value).ec != std::errc()) return std::nullopt;
  }
  return value;
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::error_code code;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder, code)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

const UsbSensorKind* kind_of(std::uint16_t vendor, std::uint16_t product) {
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds), [&](const UsbSensorKind& kind) {
    return kind.vendor == vendor && (kind.product == product || kind.product == 0);
  });
  return found == std::end(kKinds) ? nullptr : found;
}

// ATTR{key}=="value" or ATTRS{key}=="value"; also true if the line does not have the key and `or_absent`.
bool matches(const std::string& line, const std::string& key, const std::string& value, bool or_absent) {
  if (line.find("{" + key + "}") == std::string::npos) return or_absent;
  return line.find("{" + key + "}==\"" + value + "\"") != std::string::npos;
}

// The rules file that gives this device to users.
fs::path rule_for(const fs::path& root, const std::string& vendor, const std::string& product) {
  for (const char* folder : {"etc", "run", "usr/lib", "lib"})
    for (const fs::path& path : entries(root / folder / "udev" / "rules.d")) {
      if (path.extension() != ".rules") continue;
      std::ifstream file(path);
      for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#')) continue;
        const bool grants =
            line.find("MODE") != std::string::npos || line.find("uaccess") != std::string::npos;
        if (grants && matches(line, "idVendor", vendor, false) && matches(line, "idProduct", product, true))
          return path;
      }
    }
  return {};
}

std::string mode_text(mode_t mode) {
  std::string text = "rwxrwxrwx";
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((mode & (0400U >> i)) == 0) text[i] = '-';
  return text;
}

void examine_node(UsbSensor& sensor) {
  struct stat status {};
  if (::stat(sensor.node.c_str(), &status) != 0) return;
  sensor.mode = mode_text(status.st_mode);
  if (::access(sensor.node.c_str(), R_OK | W_OK) != 0) {
    sensor.access = UsbSensor::Access::denied;
    return;
  }
  const bool others = (status.st_mode & 0006) == 0006;
  const bool group = (status.st_mode & 0060) == 0060 && status.st_gid != 0;
  sensor.access =
      ::geteuid() == 0 && !others && !group ? UsbSensor::Access::root_only : UsbSensor::Access::granted;
}

std::string kernel_driver_of(const fs::path& device) {
  std::error_code code;
  const fs::path driver = fs::read_symlink(device / (device.filename().string() + ":1.0") / "driver", code);
  return code ? "" : driver.filename().string();
}

}  // namespace

std::vector<UsbSensor> find_usb_sensors(const fs::path& sysfs) {
  const fs::path root = (fs::absolute(sysfs) / "..").lexically_normal();
  std::vector<UsbSensor> sensors;
  for (const fs::path& device : entries(sysfs / "bus/usb/devices")) {
    const auto vendor = read_number<std::uint16_t>(device / "idVendor", 16);
    const auto product = read_number<std::uint16_t>(device / "idProduct", 16);
    if (!vendor || !product) continue;
    const UsbSensorKind* kind = kind_of(*vendor, *product);
    if (kind == nullptr) continue;
    UsbSensor sensor;
    sensor.kind = *kind;
    sensor.product = *product;
    sensor.place = device.filename().string();
    sensor.speed_mbps = read_number<double>(device / "speed").value_or(0);
    sensor.node = root / "dev/bus/usb" /
                  fmt::format("{:03}", read_number<int>(device / "busnum").value_or(0)) /
                  fmt::format("{:03}", read_number<int>(device / "devnum").value_or(0));
    examine_node(sensor);
    sensor.rule = rule_for(root, fmt::format("{:04x}", *vendor), fmt::format("{:04x}", *product));
    sensor.kernel_driver = kernel_driver_of(device);
    sensors.push_back(sensor);
  }
  return sensors;
}

}  // namespace saccade
