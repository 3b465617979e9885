#pragma once

#include <atomic>

#include <Driver/OniDriverAPI.h>

#include "drivers/modules/property_table.hpp"

namespace saccade {

/// A device or a stream of a driver module (`Base`: OpenNI2's DeviceBase or StreamBase) whose properties are
/// in a table. Reports each that was set to OpenNI2. Thread safety: that of PropertyTable.
template <typename Base>
class WithProperties : public Base {
 public:
  OniStatus getProperty(int id, void* data, int* size) final { return properties_.get(id, data, size); }
  OniBool isPropertySupported(int id) final { return properties_.has(id) ? TRUE : FALSE; }

  OniStatus setProperty(int id, const void* data, int size) final {
    const OniStatus status = properties_.set(id, data, size);
    if (status == ONI_STATUS_OK) raise_property_changed(id, data, size);
    return status;
  }

  void setPropertyChangedCallback(oni::driver::PropertyChangedCallback callback, void* cookie) final {
    Base::setPropertyChangedCallback(callback, cookie);
    has_listener_ = callback != nullptr;
  }

  void notifyAllProperties() final {
    properties_.for_each(
        [this](int id, const void* data, int size) { raise_property_changed(id, data, size); });
  }

 protected:
  PropertyTable properties_;  // filled by the constructors of derived classes

 private:
  void raise_property_changed(int id, const void* data, int size) {
    if (has_listener_) this->raisePropertyChanged(id, data, size);
  }

  std::atomic<bool> has_listener_ = false;  // OpenNI2 does not always give a callback
};

}  // namespace saccade
