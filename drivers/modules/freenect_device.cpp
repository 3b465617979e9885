#include "drivers/modules/freenect_device.hpp"

#include <libfreenect_registration.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.hpp"

// A library in place of libfreenect may lack these; the pragmas let OpenNI2 load the module there too.
#pragma weak freenect_set_flag
#pragma weak freenect_copy_registration
#pragma weak freenect_destroy_registration

namespace saccade {
namespace {

const cv::Size kSize(640, 480), kInfraredSize(640, 488);
constexpr int kRateHz = 30;
constexpr double kColourFocal_px = 525;

std::optional<freenect_frame_mode> find_depth_mode(freenect_depth_format format) {
  for (int i = 0; i < freenect_get_depth_mode_count(); ++i) {
    const freenect_frame_mode mode = freenect_get_depth_mode(i);
    if (mode.is_valid && mode.depth_format == format && mode.width == kSize.width &&
        mode.height == kSize.height)
      return mode;
  }
  return std::nullopt;
}

std::vector<StreamKind> kinds() {
  return {{ONI_SENSOR_DEPTH, video_modes(ONI_PIXEL_FORMAT_DEPTH_1_MM, {kSize}, {kRateHz}),
           kKinectLargestDepth_mm + 1},
          {ONI_SENSOR_COLOR, video_modes(ONI_PIXEL_FORMAT_RGB888, {kSize}, {kRateHz}), 0},
          {ONI_SENSOR_IR, video_modes(ONI_PIXEL_FORMAT_GRAY16, {kInfraredSize}, {kRateHz}), 0}};
}

FieldOfView view_of(cv::Size size, double focal_px) {
  return {2 * std::atan(size.width / 2.0 / focal_px), 2 * std::atan(size.height / 2.0 / focal_px)};
}

// The colour camera's own settings, where the library can set them. It cannot read them.
class FreenectStream : public ModuleStream {
 public:
  FreenectStream(const StreamKind& kind, const std::function<FieldOfView()>& view,
                 std::function<bool(bool)> running, const std::function<bool(freenect_flag, bool)>& set_flag)
      : ModuleStream(kind, view, std::move(running)) {
    if (kind.sensor != ONI_SENSOR_COLOR || freenect_set_flag == nullptr) return;
    add_flag(ONI_STREAM_PROPERTY_AUTO_EXPOSURE, FREENECT_AUTO_EXPOSURE, set_flag);
    add_flag(ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE, FREENECT_AUTO_WHITE_BALANCE, set_flag);
  }

 private:
  void add_flag(int id, freenect_flag flag, const std::function<bool(freenect_flag, bool)>& set_flag) {
    const auto value = std::make_shared<std::atomic<bool>>(true);  // both are on when the Kinect starts
    properties_.add<OniBool>(
        id, [value]() -> OniBool { return *value ? TRUE : FALSE; },
        [=](const OniBool& wanted) {
          if (!set_flag(flag, wanted != FALSE)) return ONI_STATUS_ERROR;
          *value = wanted != FALSE;
          return ONI_STATUS_OK;
        });
  }
};

}  // namespace

FreenectDevice::FreenectDevice(FreenectLoop& loop, int index)
    : ModuleDevice({"freenect-" + std::to_string(index), "libfreenect"}, kinds()), loop_(loop) {
  loop_.run([&](freenect_context* context) {
    if (freenect_open_device(context, &device_, index) < 0) device_ = nullptr;
    if (device_ == nullptr) return;
    freenect_set_user(device_, this);
    freenect_set_depth_callback(device_, [](freenect_device* device, void* data, std::uint32_t ticks) {
      static_cast<FreenectDevice*>(freenect_get_user(device))->take_depth(data, ticks);
    });
    freenect_set_video_callback(device_, [](freenect_device* device, void* data, std::uint32_t ticks) {
      static_cast<FreenectDevice*>(freenect_get_user(device))->take_video(data, ticks);
    });
    read_geometry();
  });
  if (device_ == nullptr)
    throw failed("cannot open the Kinect: " + FreenectLoop::take_complaint(), std::to_string(index),
                 "is the udev rule installed, and does no other program use it?");
  table_ = kinect_depth_table(geometry_);
}

FreenectDevice::~FreenectDevice() {
  loop_.run([this](freenect_context*) {
    stop_depth();
    stop_video();
    freenect_close_device(device_);
  });
}

void FreenectDevice::read_geometry() {
  if (freenect_copy_registration == nullptr || freenect_destroy_registration == nullptr) return;
  freenect_registration registration = freenect_copy_registration(device_);
  const freenect_zero_plane_info& plane = registration.zero_plane_info;
  if (plane.reference_distance > 0 && plane.reference_pixel_size > 0 && plane.dcmos_emitter_dist > 0)
    geometry_ = {plane.dcmos_emitter_dist, plane.reference_distance, plane.reference_pixel_size,
                 registration.const_shift};
  freenect_destroy_registration(&registration);
}

FieldOfView FreenectDevice::field_of_view(OniSensorType sensor) const {
  if (sensor == ONI_SENSOR_IR) return view_of(kInfraredSize, kinect_focal_px(geometry_));
  const bool infrared = sensor == ONI_SENSOR_DEPTH && registration() == ONI_IMAGE_REGISTRATION_OFF;
  return view_of(kSize, infrared ? kinect_focal_px(geometry_) : kColourFocal_px);
}

oni::driver::StreamBase* FreenectDevice::createStream(OniSensorType sensor) {
  const StreamKind* kind = kind_of(sensor);
  if (kind == nullptr) return nullptr;
  const auto set_flag = [this](freenect_flag flag, bool on) {
    bool done = false;
    loop_.run([&](freenect_context*) {
      done = freenect_set_flag(device_, flag, on ? FREENECT_ON : FREENECT_OFF) >= 0;
    });
    return done;
  };
  auto stream = std::make_shared<FreenectStream>(
      *kind, [this, sensor] { return field_of_view(sensor); },
      [this, sensor](bool start) { return change_running(sensor, start); }, set_flag);
  loop_.run([&](freenect_context*) { streams_.push_back(stream); });
  return stream.get();
}

void FreenectDevice::destroyStream(oni::driver::StreamBase* stream) {
  stream->stop();
  loop_.run(
      [&](freenect_context*) { std::erase_if(streams_, [&](const auto& s) { return s.get() == stream; }); });
}

OniBool FreenectDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF ||
                 (mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR && find_depth_mode(FREENECT_DEPTH_REGISTERED))
             ? TRUE
             : FALSE;
}

OniStatus FreenectDevice::change_registration(OniImageRegistrationMode mode) {
  bool done = true;
  loop_.run([&](freenect_context*) {
    if (!depth_running_) return;
    stop_depth();
    done = start_depth(mode);
  });
  return done ? ONI_STATUS_OK : ONI_STATUS_ERROR;
}

bool FreenectDevice::change_running(OniSensorType sensor, bool start) {
  bool done = true;
  const OniImageRegistrationMode mode = registration();
  loop_.run([&](freenect_context*) {
    const bool is_depth = sensor == ONI_SENSOR_DEPTH;
    if (start)
      done = is_depth ? start_depth(mode) : start_video(sensor);
    else if (is_depth)
      stop_depth();
    else if (video_ == sensor)
      stop_video();
  });
  return done;
}

bool FreenectDevice::start_depth(OniImageRegistrationMode mode) {
  auto wanted = find_depth_mode(mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR ? FREENECT_DEPTH_REGISTERED
                                                                              : FREENECT_DEPTH_MM);
  depth_is_raw_ = !wanted;
  if (!wanted) wanted = find_depth_mode(FREENECT_DEPTH_11BIT);
  depth_running_ =
      wanted && freenect_set_depth_mode(device_, *wanted) >= 0 && freenect_start_depth(device_) >= 0;
  if (depth_running_) loop_.set_streaming(this, true);
  return depth_running_;
}

bool FreenectDevice::start_video(OniSensorType sensor) {
  if (video_) return video_ == sensor;
  const freenect_frame_mode mode = freenect_find_video_mode(
      FREENECT_RESOLUTION_MEDIUM, sensor == ONI_SENSOR_COLOR ? FREENECT_VIDEO_RGB : FREENECT_VIDEO_IR_10BIT);
  if (!mode.is_valid || freenect_set_video_mode(device_, mode) < 0 || freenect_start_video(device_) < 0)
    return false;
  video_ = sensor;
  loop_.set_streaming(this, true);
  return true;
}

void FreenectDevice::stop_depth() {
  if (std::exchange(depth_running_, false)) freenect_stop_depth(device_);
  loop_.set_streaming(this, depth_running_ || video_);
}

void FreenectDevice::stop_video() {
  if (std::exchange(video_, std::nullopt)) freenect_stop_video(device_);
  loop_.set_streaming(this, depth_running_ || video_);
}

void FreenectDevice::take_depth(const void* data, std::uint32_t ticks) {
  depth_.create(kSize);
  std::memcpy(depth_.data, data, depth_.total() * depth_.elemSize());  // it may lie at an odd address
  if (depth_is_raw_)
    std::transform(depth_.begin(), depth_.end(), depth_.begin(),
                   [this](std::uint16_t raw) { return table_[raw & 2047U]; });
  give(ONI_SENSOR_DEPTH, depth_, ++depth_frames_, ticks);
}

void FreenectDevice::take_video(const void* data, std::uint32_t ticks) {
  if (!video_) return;
  const bool colour = video_ == ONI_SENSOR_COLOR;
  image_.create(colour ? kSize : kInfraredSize, colour ? CV_8UC3 : CV_16UC1);
  std::memcpy(image_.data, data, image_.total() * image_.elemSize());
  give(*video_, image_, ++video_frames_, ticks);
}

void FreenectDevice::give(OniSensorType sensor, const cv::Mat& image, int index, std::uint32_t ticks) {
  const std::uint64_t time_us = clock_.microseconds(ticks);
  for (const auto& stream : streams_)
    if (stream->kind().sensor == sensor) stream->deliver(image, index, time_us);
}

}  // namespace saccade
