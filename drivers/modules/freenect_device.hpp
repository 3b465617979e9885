#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "drivers/modules/freenect_loop.hpp"
#include "drivers/modules/kinect_depth.hpp"
#include "drivers/modules/module_device.hpp"

namespace saccade {

/// A Kinect v1 as an OpenNI2 device: depth in mm, colour as RGB, infrared as 16-bit grey (640 x 488, as the
/// camera gives it). Colour and infrared share a camera channel: one of them at a time.
///
/// Depth comes from libfreenect in mm, on the colour image where that is asked for (image registration); a
/// library that knows neither gives raw values, which kinect_depth.hpp converts. The field of view of depth
/// is that of the infrared camera, or of the colour camera when registered. The tilt is left alone.
class FreenectDevice final : public ModuleDevice {
 public:
  /// Opens Kinect `index`. Throws Error (failed) with libfreenect's reason.
  FreenectDevice(FreenectLoop& loop, int index);
  ~FreenectDevice() override;

  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 private:
  OniStatus change_registration(OniImageRegistrationMode mode) override;
  bool change_running(OniSensorType sensor, bool start);
  FieldOfView field_of_view(OniSensorType sensor) const;
  void read_geometry();

  // On the loop's thread.
  bool start_depth(OniImageRegistrationMode mode);
  bool start_video(OniSensorType sensor);
  void stop_depth();
  void stop_video();
  void take_depth(const void* data, std::uint32_t ticks);
  void take_video(const void* data, std::uint32_t ticks);
  void give(OniSensorType sensor, const cv::Mat& image, int index, std::uint32_t ticks);

  FreenectLoop& loop_;
  freenect_device* device_ = nullptr;
  KinectGeometry geometry_;
  std::array<std::uint16_t, 2048> table_{};

  // The loop's thread only.
  std::vector<std::shared_ptr<ModuleStream>> streams_;
  std::optional<OniSensorType> video_;  // what the video channel carries
  bool depth_running_ = false, depth_is_raw_ = false;
  int depth_frames_ = 0, video_frames_ = 0;
  KinectClock clock_;
  cv::Mat1w depth_;
  cv::Mat image_;  // colour or infrared
};

}  // namespace saccade
