#include "drivers/openni2/driver_functions.hpp"

#include <dlfcn.h>

namespace saccade {
namespace {

// Calls visit(name, member) for each function of the interface.
template <typename Visit>
void for_each_function(DriverFunctions& f, const Visit& visit) {
  visit("Create", f.create);
  visit("Destroy", f.destroy);
  visit("Initialize", f.initialize);
  visit("TryDevice", f.try_device);
  visit("DeviceOpen", f.device_open);
  visit("DeviceClose", f.device_close);
  visit("DeviceGetSensorInfoList", f.device_get_sensor_info_list);
  visit("DeviceCreateStream", f.device_create_stream);
  visit("DeviceDestroyStream", f.device_destroy_stream);
  visit("DeviceSetProperty", f.device_set_property);
  visit("DeviceGetProperty", f.device_get_property);
  visit("DeviceIsPropertySupported", f.device_is_property_supported);
  visit("DeviceSetPropertyChangedCallback", f.device_set_property_changed_callback);
  visit("DeviceNotifyAllProperties", f.device_notify_all_properties);
  visit("DeviceInvoke", f.device_invoke);
  visit("DeviceIsCommandSupported", f.device_is_command_supported);
  visit("DeviceTryManualTrigger", f.device_try_manual_trigger);
  visit("DeviceIsImageRegistrationModeSupported", f.device_is_image_registration_mode_supported);
  visit("StreamSetServices", f.stream_set_services);
  visit("StreamSetProperty", f.stream_set_property);
  visit("StreamGetProperty", f.stream_get_property);
  visit("StreamIsPropertySupported", f.stream_is_property_supported);
  visit("StreamSetPropertyChangedCallback", f.stream_set_property_changed_callback);
  visit("StreamNotifyAllProperties", f.stream_notify_all_properties);
  visit("StreamInvoke", f.stream_invoke);
  visit("StreamIsCommandSupported", f.stream_is_command_supported);
  visit("StreamStart", f.stream_start);
  visit("StreamStop", f.stream_stop);
  visit("StreamGetRequiredFrameSize", f.stream_get_required_frame_size);
  visit("StreamSetNewFrameCallback", f.stream_set_new_frame_callback);
  visit("StreamConvertDepthToColorCoordinates", f.stream_convert_depth_to_color_coordinates);
  visit("EnableFrameSync", f.enable_frame_sync);
  visit("DisableFrameSync", f.disable_frame_sync);
}

}  // namespace

DriverFunctions find_driver_functions(void* handle) {
  DriverFunctions functions{};
  for_each_function(functions, [&](const std::string& name, auto& member) {
    using Function = std::remove_reference_t<decltype(member)>;
    member = reinterpret_cast<Function>(::dlsym(handle, ("oniDriver" + name).c_str()));
  });
  return functions;
}

std::vector<std::string> missing_driver_functions(void* handle) {
  std::vector<std::string> missing;
  DriverFunctions functions = find_driver_functions(handle);
  for_each_function(functions, [&](const std::string& name, const auto& member) {
    if (member == nullptr) missing.push_back("oniDriver" + name);
  });
  return missing;
}

}  // namespace saccade
