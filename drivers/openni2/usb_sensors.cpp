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

constexpr const char* kMaker = "name its maker's OpenNI2 module in SACCADE_OPENNI2_DRIVERS";
constexpr const char* kKinect2 =
    "build libfreenect2 with its OpenNI2 driver and name that module in SACCADE_OPENNI2_DRIVERS";
constexpr const char* kAzure =
    "there is no OpenNI2 module for it: record with Microsoft's k4arecorder and export depth images (16-bit "
    "PNG, "
    "mm) into a folder, which Saccade reads";
constexpr const char* kOrbbecOpenNi =
    "name liborbbec.so of Orbbec's OpenNI2 SDK in SACCADE_OPENNI2_DRIVERS, and install its udev rules";
constexpr const char* kOrbbec =
    "Astra, Dabai and the first Gemini speak OpenNI: name liborbbec.so of Orbbec's OpenNI2 SDK in "
    "SACCADE_OPENNI2_DRIVERS; newer ones (Astra 2, Gemini 2, Femto) need Orbbec's own SDK, whose recordings "
    "can be "
    "exported as depth images";
constexpr const char* kRealSense =
    "build the OpenNI2 driver of librealsense (wrappers/openni2) and name it in SACCADE_OPENNI2_DRIVERS, or "
    "record "
    "with realsense-viewer and export depth images";

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
    {0x045e, 0x02c4, "Kinect v2", Part::unsupported, "", kKinect2},
    {0x045e, 0x02d8, "Kinect v2", Part::unsupported, "", kKinect2},
    {0x045e, 0x097c, "Azure Kinect, depth camera", Part::unsupported, "", kAzure},
    {0x0b05, 0x1a26, "Asus Xtion 2", Part::unsupported, "", kMaker},
    {0x2bc5, 0x0401, "Orbbec Astra", Part::unsupported, "", kOrbbecOpenNi},
    {0x2bc5, 0x0402, "Orbbec Astra S", Part::unsupported, "", kOrbbecOpenNi},
    {0x2bc5, 0x0403, "Orbbec Astra Pro", Part::unsupported, "", kOrbbecOpenNi},
    {0x2bc5, 0x0404, "Orbbec Astra Mini", Part::unsupported, "", kOrbbecOpenNi},
    {0x2bc5, 0x0407, "Orbbec Astra Mini S", Part::unsupported, "", kOrbbecOpenNi},
    {0x2bc5, 0x0000, "Orbbec sensor", Part::unsupported, "", kOrbbec},
    {0x2959, 0x0000, "Structure sensor of Occipital", Part::unsupported, "", kMaker},
    {0x8086, 0x0aa5, "Intel RealSense SR300", Part::unsupported, "", kRealSense},
    {0x8086, 0x0b48, "Intel RealSense SR305", Part::unsupported, "", kRealSense},
    {0x8086, 0x0ad1, "Intel RealSense D400", Part::unsupported, "", kRealSense},
    {0x8086, 0x0ad2, "Intel RealSense D410", Part::unsupported, "", kRealSense},
    {0x8086, 0x0ad3, "Intel RealSense D415", Part::unsupported, "", kRealSense},
    {0x8086, 0x0ad4, "Intel RealSense D430", Part::unsupported, "", kRealSense},
    {0x8086, 0x0af6, "Intel RealSense D420", Part::unsupported, "", kRealSense},
    {0x8086, 0x0b07, "Intel RealSense D435", Part::unsupported, "", kRealSense},
    {0x8086, 0x0b3a, "Intel RealSense D435i", Part::unsupported, "", kRealSense},
    {0x8086, 0x0b5b, "Intel RealSense D405", Part::unsupported, "", kRealSense},
    {0x8086, 0x0b5c, "Intel RealSense D455", Part::unsupported, "", kRealSense},
    {0x8086, 0x0b64, "Intel RealSense L515", Part::unsupported, "", kRealSense},
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
