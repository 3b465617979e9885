#include "drivers/modules/module_device.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/version.hpp"

namespace saccade {

ModuleDevice::ModuleDevice(const Identity& identity, std::vector<StreamKind> streams)
    : kinds_(std::move(streams)) {
  for (StreamKind& kind : kinds_)
    sensors_.push_back({kind.sensor, static_cast<int>(kind.modes.size()), kind.modes.data()});
  properties_.add_text(ONI_DEVICE_PROPERTY_SERIAL_NUMBER, identity.serial);
  properties_.add_text(ONI_DEVICE_PROPERTY_FIRMWARE_VERSION, identity.firmware);
  properties_.add<OniVersion>(ONI_DEVICE_PROPERTY_DRIVER_VERSION, [] {
    return OniVersion{kVersionMajor, kVersionMinor, kVersionPatch, 0};
  });
  properties_.add<int>(ONI_DEVICE_PROPERTY_HARDWARE_VERSION, [] { return 1; });
  properties_.add<OniImageRegistrationMode>(
      ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION, [this] { return registration(); },
      [this](const OniImageRegistrationMode& mode) {
        if (!isImageRegistrationModeSupported(mode)) return ONI_STATUS_NOT_SUPPORTED;
        const OniStatus status = change_registration(mode);
        if (status != ONI_STATUS_OK) return status;
        const std::lock_guard lock(mutex_);
        registration_ = mode;
        return ONI_STATUS_OK;
      });
}

OniStatus ModuleDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

OniBool ModuleDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR ? TRUE : FALSE;
}

const StreamKind* ModuleDevice::kind_of(OniSensorType sensor) const {
  const auto found = std::find_if(kinds_.begin(), kinds_.end(),
                                  [&](const StreamKind& kind) { return kind.sensor == sensor; });
  return found == kinds_.end() ? nullptr : &*found;
}

OniImageRegistrationMode ModuleDevice::registration() const {
  const std::lock_guard lock(mutex_);
  return registration_;
}

OniDeviceInfo device_info(const std::string& uri, const std::string& vendor, const std::string& name,
                          int usb_vendor, int usb_product) {
  OniDeviceInfo info{};
  const auto copy = [](char(&to)[ONI_MAX_STR], const std::string& from) {
    std::memcpy(to, from.data(), std::min<std::size_t>(from.size(), ONI_MAX_STR - 1));
  };
  copy(info.uri, uri);
  copy(info.vendor, vendor);
  copy(info.name, name);
  info.usbVendorId = static_cast<std::uint16_t>(usb_vendor);
  info.usbProductId = static_cast<std::uint16_t>(usb_product);
  return info;
}

}  // namespace saccade
