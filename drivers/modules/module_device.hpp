#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <Driver/OniDriverAPI.h>

#include "drivers/modules/module_stream.hpp"
#include "drivers/modules/property_table.hpp"

namespace saccade {

/// What the driver modules' devices have in common: the list of their sensors and the properties that OpenNI2
/// and its programs ask for. A module derives from it and makes the streams.
/// Thread safety: OpenNI2 calls from any thread.
class ModuleDevice : public oni::driver::DeviceBase {
 public:
  struct Identity {
    std::string serial, firmware;
  };

  ModuleDevice(const Identity& identity, std::vector<StreamKind> streams);

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) final;
  OniStatus getProperty(int id, void* data, int* size) final { return properties_.get(id, data, size); }
  OniStatus setProperty(int id, const void* data, int size) final;
  OniBool isPropertySupported(int id) final { return properties_.has(id) ? TRUE : FALSE; }
  void setPropertyChangedCallback(oni::driver::PropertyChangedCallback callback, void* cookie) final;
  void notifyAllProperties() final;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 protected:
  /// nullptr if there is no such sensor.
  const StreamKind* kind_of(OniSensorType sensor) const;

  OniImageRegistrationMode registration() const;
  /// Refuses by any status but OK; what is accepted is kept and read back.
  virtual OniStatus change_registration(OniImageRegistrationMode mode) = 0;

  PropertyTable properties_;  // filled by the constructors

 private:
  void tell_changed(int id, const void* data, int size);
  std::vector<StreamKind> kinds_;
  std::vector<OniSensorInfo> sensors_;      // points into kinds_
  std::atomic<bool> has_listener_ = false;  // OpenNI2 does not always give a callback
  mutable std::mutex mutex_;
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;  // guarded by mutex_
};

/// A device as it is announced. `name`, `vendor` and `uri` are cut to the room there is.
OniDeviceInfo device_info(const std::string& uri, const std::string& vendor, const std::string& name,
                          int usb_vendor, int usb_product);

}  // namespace saccade
