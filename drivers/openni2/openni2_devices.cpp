#include "drivers/openni2/openni2_devices.hpp"

#include <array>

#include <OpenNI.h>

#include "drivers/openni2/module_file.hpp"
#include "drivers/openni2/openni2_modes.hpp"
#include "drivers/openni2/openni2_thread.hpp"

namespace saccade {
namespace {

// OpenNI2 does not say which module a device comes from; the form of its URI does.
std::string driver_of(const DeviceIdentity& device) {
  if (device.uri.starts_with("saccade-virtual:")) return "SaccadeVirtual";
  if (device.uri.starts_with("freenect:")) return "SaccadeFreenect";
  constexpr int kPrimeSense = 0x1d27;
  if (device.usb_vendor != kPrimeSense) return "";
  return device.usb_product == 0x0600 || device.usb_product == 0x0601 ? "PS1080" : "PSLink";
}

// Empty if the device does not have it.
std::string text_property(const openni::Device& device, int id) {
  std::array<char, 4096> text{};
  int size = static_cast<int>(text.size()) - 1;
  return device.getProperty(id, text.data(), &size) == openni::STATUS_OK ? text.data() : "";
}

void open_and_look(DeviceListing& listing) {
  openni::Device device;
  if (device.open(listing.identity.uri.c_str()) != openni::STATUS_OK) {
    listing.problem = "it cannot be opened: " + openni2_complaint();
    return;
  }
  listing.serial = text_property(device, openni::DEVICE_PROPERTY_SERIAL_NUMBER);
  if (device.isPropertySupported(kModuleFileProperty) && listing.driver.empty())
    listing.driver = text_property(device, kModuleFileProperty);
  listing.depth_modes = names_of(depth_modes(device));
  listing.colour_modes = names_of(colour_modes(device));
  device.close();
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

std::string serial_of(const DeviceIdentity& identity) {
  std::string serial;
  on_openni2_thread([&] {
    openni::Device device;
    if (device.open(identity.uri.c_str()) != openni::STATUS_OK) return;
    serial = text_property(device, openni::DEVICE_PROPERTY_SERIAL_NUMBER);
    device.close();
  });
  return serial;
}

void look_into(DeviceListing& listing) {
  on_openni2_thread([&listing] { open_and_look(listing); });
}

}  // namespace saccade
