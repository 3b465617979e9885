#include "drivers/modules/bridged_device.hpp"

#include <cstring>

#include "drivers/openni2/module_file.hpp"

namespace saccade {

void BridgedStream::setServices(oni::driver::StreamServices* services) {
  f_.stream_set_services(handle_, services);
}

OniStatus BridgedStream::setProperty(int id, const void* data, int size) {
  return f_.stream_set_property(handle_, id, data, size);
}

OniStatus BridgedStream::getProperty(int id, void* data, int* size) {
  return f_.stream_get_property(handle_, id, data, size);
}

OniBool BridgedStream::isPropertySupported(int id) { return f_.stream_is_property_supported(handle_, id); }

OniStatus BridgedStream::invoke(int command, void* data, int size) {
  return f_.stream_invoke(handle_, command, data, size);
}

OniBool BridgedStream::isCommandSupported(int command) {
  return f_.stream_is_command_supported(handle_, command);
}

int BridgedStream::getRequiredFrameSize() { return f_.stream_get_required_frame_size(handle_); }

OniStatus BridgedStream::start() { return f_.stream_start(handle_); }

void BridgedStream::stop() { f_.stream_stop(handle_); }

// OpenNI2 is to see this stream as the sender, not the module's.
void BridgedStream::setNewFrameCallback(oni::driver::NewFrameCallback handler, void* cookie) {
  StreamBase::setNewFrameCallback(handler, cookie);
  const DriverFunctions::NewFrame pass_on = [](void*, OniFrame* frame, void* self) {
    static_cast<BridgedStream*>(self)->raiseNewFrame(frame);
  };
  f_.stream_set_new_frame_callback(handle_, handler == nullptr ? nullptr : pass_on, this);
}

void BridgedStream::setPropertyChangedCallback(oni::driver::PropertyChangedCallback handler, void* cookie) {
  StreamBase::setPropertyChangedCallback(handler, cookie);
  const DriverFunctions::PropertyChanged pass_on = [](void*, int id, const void* data, int size, void* self) {
    static_cast<BridgedStream*>(self)->raisePropertyChanged(id, data, size);
  };
  f_.stream_set_property_changed_callback(handle_, handler == nullptr ? nullptr : pass_on, this);
}

void BridgedStream::notifyAllProperties() { f_.stream_notify_all_properties(handle_); }

// Both streams are of one device, and so of one module.
OniStatus BridgedStream::convertDepthToColorCoordinates(StreamBase* colour, int depth_x, int depth_y,
                                                        OniDepthPixel depth, int* colour_x, int* colour_y) {
  return f_.stream_convert_depth_to_color_coordinates(handle_, static_cast<BridgedStream*>(colour)->handle(),
                                                      depth_x, depth_y, depth, colour_x, colour_y);
}

OniStatus BridgedDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  return module_.functions.device_get_sensor_info_list(handle_, sensors, count);
}

oni::driver::StreamBase* BridgedDevice::createStream(OniSensorType sensor) {
  void* stream = module_.functions.device_create_stream(handle_, sensor);
  return stream == nullptr ? nullptr : new BridgedStream(module_, stream);
}

void BridgedDevice::destroyStream(oni::driver::StreamBase* stream) {
  module_.functions.device_destroy_stream(handle_, static_cast<BridgedStream*>(stream)->handle());
  delete stream;
}

OniStatus BridgedDevice::setProperty(int id, const void* data, int size) {
  return module_.functions.device_set_property(handle_, id, data, size);
}

OniStatus BridgedDevice::getProperty(int id, void* data, int* size) {
  if (id != kModuleFileProperty) return module_.functions.device_get_property(handle_, id, data, size);
  const std::string& file = module_.file.native();
  const int needed = static_cast<int>(file.size()) + 1;
  if (*size < needed) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, file.c_str(), static_cast<std::size_t>(needed));
  *size = needed;
  return ONI_STATUS_OK;
}

OniBool BridgedDevice::isPropertySupported(int id) {
  return id == kModuleFileProperty ? TRUE : module_.functions.device_is_property_supported(handle_, id);
}

OniStatus BridgedDevice::invoke(int command, void* data, int size) {
  return module_.functions.device_invoke(handle_, command, data, size);
}

OniBool BridgedDevice::isCommandSupported(int command) {
  return module_.functions.device_is_command_supported(handle_, command);
}

OniStatus BridgedDevice::tryManualTrigger() { return module_.functions.device_try_manual_trigger(handle_); }

void BridgedDevice::setPropertyChangedCallback(oni::driver::PropertyChangedCallback handler, void* cookie) {
  DeviceBase::setPropertyChangedCallback(handler, cookie);
  const DriverFunctions::PropertyChanged pass_on = [](void*, int id, const void* data, int size, void* self) {
    static_cast<BridgedDevice*>(self)->raisePropertyChanged(id, data, size);
  };
  module_.functions.device_set_property_changed_callback(handle_, handler == nullptr ? nullptr : pass_on,
                                                         this);
}

void BridgedDevice::notifyAllProperties() { module_.functions.device_notify_all_properties(handle_); }

OniBool BridgedDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return module_.functions.device_is_image_registration_mode_supported(handle_, mode);
}

}  // namespace saccade
