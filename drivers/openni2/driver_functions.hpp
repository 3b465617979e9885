#pragma once

#include <string>
#include <vector>

#include <Driver/OniDriverTypes.h>

namespace saccade {

/// The functions that a driver module offers to OpenNI2, by their C interface; handles are the module's own.
/// The member `device_open` is the function oniDriverDeviceOpen, and so on.
struct DriverFunctions {
  using Connected = void (*)(const OniDeviceInfo*, void* cookie);
  using StateChanged = void (*)(const OniDeviceInfo*, int state, void* cookie);
  using NewFrame = void (*)(void* stream, OniFrame*, void* cookie);
  using PropertyChanged = void (*)(void* sender, int id, const void* data, int size, void* cookie);

  void (*create)(OniDriverServices*);
  void (*destroy)();
  OniStatus (*initialize)(Connected, Connected disconnected, StateChanged, void* cookie);
  OniStatus (*try_device)(const char* uri);
  void* (*device_open)(const char* uri, const char* mode);
  void (*device_close)(void*);
  OniStatus (*device_get_sensor_info_list)(void*, OniSensorInfo**, int* count);
  void* (*device_create_stream)(void*, OniSensorType);
  void (*device_destroy_stream)(void*, void* stream);
  OniStatus (*device_set_property)(void*, int id, const void* data, int size);
  OniStatus (*device_get_property)(void*, int id, void* data, int* size);
  OniBool (*device_is_property_supported)(void*, int id);
  void (*device_set_property_changed_callback)(void*, PropertyChanged, void* cookie);
  void (*device_notify_all_properties)(void*);
  OniStatus (*device_invoke)(void*, int command, void* data, int size);
  OniBool (*device_is_command_supported)(void*, int command);
  OniStatus (*device_try_manual_trigger)(void*);
  OniBool (*device_is_image_registration_mode_supported)(void*, OniImageRegistrationMode);
  void (*stream_set_services)(void*, OniStreamServices*);
  OniStatus (*stream_set_property)(void*, int id, const void* data, int size);
  OniStatus (*stream_get_property)(void*, int id, void* data, int* size);
  OniBool (*stream_is_property_supported)(void*, int id);
  void (*stream_set_property_changed_callback)(void*, PropertyChanged, void* cookie);
  void (*stream_notify_all_properties)(void*);
  OniStatus (*stream_invoke)(void*, int command, void* data, int size);
  OniBool (*stream_is_command_supported)(void*, int command);
  OniStatus (*stream_start)(void*);
  void (*stream_stop)(void*);
  int (*stream_get_required_frame_size)(void*);
  void (*stream_set_new_frame_callback)(void*, NewFrame, void* cookie);
  OniStatus (*stream_convert_depth_to_color_coordinates)(void*, void* colour, int x, int y, OniDepthPixel z,
                                                         int* colour_x, int* colour_y);
  void* (*enable_frame_sync)(void** streams, int count);
  void (*disable_frame_sync)(void* group);
};

/// The functions of a module that was loaded with dlopen(). Those that it lacks are nullptr.
[[nodiscard]] DriverFunctions find_driver_functions(void* handle);

/// The names of the functions that it lacks.
[[nodiscard]] std::vector<std::string> missing_driver_functions(void* handle);

}  // namespace saccade
