#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <Driver/OniDriverAPI.h>

#include "drivers/modules/module_stream.hpp"
#include "drivers/modules/with_properties.hpp"

namespace saccade {

/// The common part of the driver modules' devices: the list of their sensors and the properties that OpenNI2
/// and its programs read. A module derives from it and makes the streams.
/// Thread safety: OpenNI2 calls from any thread.
class ModuleDevice : public WithProperties<oni::driver::DeviceBase> {
 public:
  struct Identity {
    std::string serial, firmware;
  };

  ModuleDevice(const Identity& identity, std::vector<StreamKind> streams);

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) final;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 protected:
  /// nullptr if there is no such sensor.
  const StreamKind* kind_of(OniSensorType sensor) const;

  OniImageRegistrationMode registration() const;
  /// Any status but OK refuses; an accepted mode is kept and read back.
  virtual OniStatus change_registration(OniImageRegistrationMode mode) = 0;

 private:
  std::vector<StreamKind> kinds_;
  std::vector<OniSensorInfo> sensors_;  // points into kinds_
  mutable std::mutex mutex_;
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;  // guarded by mutex_
};

/// A device as it is announced. `name`, `vendor` and `uri` are cut to the room there is.
OniDeviceInfo device_info(const std::string& uri, const std::string& vendor, const std::string& name,
                          int usb_vendor, int usb_product);

}  // namespace saccade
