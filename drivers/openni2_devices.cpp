#include "drivers/openni2_devices.hpp"

#include <algorithm>
#include <array>

#include <OpenNI.h>

namespace saccade {
namespace {

// OpenNI2 does not tell which module a device comes from; the form of its URI does.
std::string driver_of(const DeviceIdentity& device) {
  if (device.uri.starts_with("saccade-virtual:")) return "SaccadeVirtual";
  if (device.uri.starts_with("freenect:")) return "SaccadeFreenect";
  constexpr int kPrimeSense = 0x1d27;
  if (device.usb_vendor != kPrimeSense) return "";
  return device.usb_product == 0x0600 || device.usb_product == 0x0601 ? "PS1080" : "PSLink";
}

std::vector<SensorMode> modes_of(openni::Device& device, openni::SensorType sensor,
                                 std::initializer_list<openni::PixelFormat> formats) {
  std::vector<SensorMode> modes;
  const openni::SensorInfo* info = device.getSensorInfo(sensor);
  if (info == nullptr) return modes;
  const auto& all = info->getSupportedVideoModes();
  for (int i = 0; i < all.getSize(); ++i) {
    const SensorMode mode{all[i].getResolutionX(), all[i].getResolutionY(), all[i].getFps()};
    if (std::find(formats.begin(), formats.end(), all[i].getPixelFormat()) != formats.end() &&
        std::find(modes.begin(), modes.end(), mode) == modes.end())
      modes.push_back(mode);
  }
  return modes;
}

}  // namespace

std::vector<DeviceListing> list_devices() {
  std::vector<DeviceListing> list;
  for (const DeviceIdentity& identity : OpenNi2Runtime::instance().devices()) {
    DeviceListing device;
    device.identity = identity;
    device.source = "openni2:" + identity.uri;
    device.driver = driver_of(identity);
    list.push_back(std::move(device));
  }
  return list;
}

void look_into(DeviceListing& listing) {
  openni::Device device;
  if (device.open(listing.identity.uri.c_str()) != openni::STATUS_OK) {
    listing.problem = openni::OpenNI::getExtendedError();
    while (!listing.problem.empty() && listing.problem.back() == '\n') listing.problem.pop_back();
    if (listing.problem.empty()) listing.problem = "it cannot be opened";
    return;
  }
  std::array<char, 256> serial{};
  int size = static_cast<int>(serial.size()) - 1;
  if (device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial.data(), &size) == openni::STATUS_OK)
    listing.serial = serial.data();
  listing.depth_modes = modes_of(device, openni::SENSOR_DEPTH,
                                 {openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM});
  listing.colour_modes = modes_of(device, openni::SENSOR_COLOR, {openni::PIXEL_FORMAT_RGB888});
  device.close();
}

}  // namespace saccade
