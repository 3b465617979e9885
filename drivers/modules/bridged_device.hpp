#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <Driver/OniDriverAPI.h>

#include "drivers/openni2/driver_functions.hpp"

namespace saccade {

/// A driver module of another maker, loaded. It stays in memory: modules do not support being unloaded.
struct BridgedModule {
  std::filesystem::path file;
  DriverFunctions functions{};
};

/// A stream of another maker's module, which gets all calls. Thread safety: that of the module.
class BridgedStream final : public oni::driver::StreamBase {
 public:
  BridgedStream(const BridgedModule& module, void* handle) : f_(module.functions), handle_(handle) {}

  void* handle() const { return handle_; }

  void setServices(oni::driver::StreamServices* services) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniStatus invoke(int command, void* data, int size) override;
  OniBool isCommandSupported(int command) override;
  int getRequiredFrameSize() override;
  OniStatus start() override;
  void stop() override;
  void setNewFrameCallback(oni::driver::NewFrameCallback handler, void* cookie) override;
  void setPropertyChangedCallback(oni::driver::PropertyChangedCallback handler, void* cookie) override;
  void notifyAllProperties() override;
  OniStatus convertDepthToColorCoordinates(StreamBase* colour, int depth_x, int depth_y, OniDepthPixel depth,
                                           int* colour_x, int* colour_y) override;

 private:
  const DriverFunctions& f_;
  void* const handle_;
};

/// A device of another maker's module, which gets all calls but one: it also has the property
/// kModuleFileProperty. Thread safety: that of the module.
class BridgedDevice final : public oni::driver::DeviceBase {
 public:
  BridgedDevice(const BridgedModule& module, void* handle) : module_(module), handle_(handle) {}

  const BridgedModule& module() const { return module_; }
  void* handle() const { return handle_; }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniStatus invoke(int command, void* data, int size) override;
  OniBool isCommandSupported(int command) override;
  OniStatus tryManualTrigger() override;
  void setPropertyChangedCallback(oni::driver::PropertyChangedCallback handler, void* cookie) override;
  void notifyAllProperties() override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 private:
  const BridgedModule& module_;
  void* const handle_;
};

}  // namespace saccade
