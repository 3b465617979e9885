#include "drivers/openni2/openni2_device.hpp"

#include <algorithm>
#include <cmath>

#include <OpenNI.h>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/depth_units.hpp"
#include "core/error.hpp"
#include "core/fit_colour.hpp"
#include "core/text.hpp"
#include "drivers/openni2/openni2_modes.hpp"

namespace saccade {
namespace {

constexpr const char* kDoctorHint = "saccade doctor looks for the reason";

// Whether a frame's memory holds an image of this size.
Outcome check_memory(const openni::VideoFrameRef& frame, cv::Size size, int bytes_per_pixel) {
  if (frame.getWidth() != size.width || frame.getHeight() != size.height)
    return Outcome::failure(
        fmt::format("it is {}x{}, not {}x{}", frame.getWidth(), frame.getHeight(), size.width, size.height));
  const std::int64_t stride = frame.getStrideInBytes();
  const std::int64_t needed = stride * size.height;
  if (frame.getData() == nullptr || stride < std::int64_t{size.width} * bytes_per_pixel ||
      frame.getDataSize() < needed)
    return Outcome::failure(fmt::format("it has {}, not {}", counted(frame.getDataSize(), "byte"),
                                        std::max(needed, std::int64_t{size.area()} * bytes_per_pixel)));
  return Outcome::success();
}

cv::Mat as_image(const openni::VideoFrameRef& frame, int type) {
  return {frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
          static_cast<std::size_t>(frame.getStrideInBytes())};
}

template <typename T>
std::optional<T> property(const openni::VideoStream& stream, int id) {
  T value{};
  if (!stream.isPropertySupported(id) || stream.getProperty(id, &value) != openni::STATUS_OK)
    return std::nullopt;
  return value;
}

std::optional<bool> truth(const openni::VideoStream& stream, int id) {
  const auto value = property<OniBool>(stream, id);
  if (!value) return std::nullopt;
  return *value != FALSE;
}

}  // namespace

// OpenNI2 crashes or hangs in stop() and destroy() while a NewFrameListener is attached, because its own
// thread may be inside the listener (12 and 18 of 80 runs with a listener; none of 80 without one, or with
// one removed before stop()). So there is no listener: one thread waits, reads and closes, no frame is held
// after it is copied, and no pause is needed.
struct OpenNi2Device::Streams {
  ~Streams() {
    for (openni::VideoStream* stream : {&depth, &colour})
      if (stream->isValid()) stream->stop();
    for (openni::VideoStream* stream : {&depth, &colour})
      if (stream->isValid()) stream->destroy();
    device.close();
  }

  openni::Device device;
  openni::VideoStream depth, colour;
  openni::VideoStream* all[2] = {&depth, &colour};
};

OpenNi2Device::OpenNi2Device(const DeviceIdentity& identity, const SensorSettings& settings,
                             const SensorValues& wanted)
    : identity_(identity), streams_(std::make_unique<Streams>()) {
  if (streams_->device.open(identity_.uri.c_str()) != openni::STATUS_OK)
    throw failed(fmt::format("the device cannot be opened: {}", openni2_complaint()), identity_.uri,
                 kDoctorHint);
  if (streams_->depth.create(streams_->device, openni::SENSOR_DEPTH) != openni::STATUS_OK)
    throw failed("the device has no depth stream", identity_.uri, kDoctorHint);
  if (streams_->device.hasSensor(openni::SENSOR_COLOR))
    streams_->colour.create(streams_->device, openni::SENSOR_COLOR);
  choose_modes(settings.mode);
  // Colour first, so that the first depth frame finds its own.
  if (has_colour() && streams_->colour.start() != openni::STATUS_OK) {
    notes_.emplace_back("the colour stream does not start; there is depth only");
    streams_->colour.destroy();
  }
  if (streams_->depth.start() != openni::STATUS_OK)
    throw failed(fmt::format("the depth stream does not start: {}", openni2_complaint()), identity_.uri,
                 kDoctorHint);
  opening_notes_ = notes_.size();
  apply(wanted);
}

OpenNi2Device::~OpenNi2Device() = default;

bool OpenNi2Device::has_colour() const { return streams_->colour.isValid(); }

void OpenNi2Device::choose_modes(const std::optional<SensorMode>& wanted) {
  const std::vector<OfferedMode> offered = depth_modes(streams_->device);
  modes_ = names_of(offered);
  const int index = nearest_mode(modes_, wanted.value_or(SensorMode{}));
  if (index < 0) throw failed("the device has no depth mode that can be used", identity_.uri, kDoctorHint);
  const OfferedMode& nearest = offered[static_cast<std::size_t>(index)];
  if (wanted && nearest.mode != *wanted) {
    std::vector<std::string> texts;
    for (const SensorMode& mode : modes_) texts.push_back(to_text(mode));
    throw usage_error(fmt::format("the device has no mode {}", to_text(*wanted)), identity_.uri,
                      fmt::format("--mode takes one of {}", fmt::join(texts, ", ")));
  }
  streams_->depth.setVideoMode(nearest.original);
  const SensorMode mode = to_mode(streams_->depth.getVideoMode());
  if (mode != wanted.value_or(SensorMode{}))
    notes_.push_back(
        fmt::format("depth comes as {}, not as {}", to_text(mode), to_text(wanted.value_or(SensorMode{}))));
  size_ = {mode.width, mode.height};
  rate_hz_ = mode.rate_hz;
  if (has_colour()) choose_colour_mode(mode);
}

void OpenNi2Device::choose_colour_mode(const SensorMode& depth) {
  const std::vector<OfferedMode> offered = colour_modes(streams_->device);
  const int index = nearest_mode(names_of(offered), depth);
  if (index < 0) {
    notes_.emplace_back("the colour stream has no format that can be used; there is depth only");
    streams_->colour.destroy();
    return;
  }
  streams_->colour.setVideoMode(offered[static_cast<std::size_t>(index)].original);
  const SensorMode mode = to_mode(streams_->colour.getVideoMode());
  if (mode.width != depth.width || mode.height != depth.height)
    notes_.push_back(fmt::format("colour is {}x{} and is scaled to the depth's {}x{}", mode.width,
                                 mode.height, depth.width, depth.height));
}

void OpenNi2Device::apply(const SensorValues& wanted) {
  notes_.resize(opening_notes_);
  if (wanted.registration) set_registration(*wanted.registration);
  if (wanted.mirror) set_mirror(*wanted.mirror);
  if (has_colour()) set_camera(wanted);
  read_back();
  note_differences(wanted);
  find_intrinsics();
}

void OpenNi2Device::note_differences(const SensorValues& wanted) {
  // `usual` is how a device without the setting behaves; if that was wanted there is nothing to report.
  const auto compare = [&](const char* what, std::optional<bool> asked, std::optional<bool> is, bool usual) {
    if (!asked || *asked == is.value_or(usual)) return;
    notes_.push_back(fmt::format("{} was turned {}, but the device {}", what, *asked ? "on" : "off",
                                 !is   ? "cannot change it"
                                 : *is ? "says that it is on"
                                       : "says that it is off"));
  };
  compare("mirroring", wanted.mirror, values_.mirror, false);
  if (!has_colour()) return;
  compare("registration", wanted.registration, values_.registration, false);
  compare("automatic exposure", wanted.auto_exposure, values_.auto_exposure, true);
  compare("automatic white balance", wanted.auto_white_balance, values_.auto_white_balance, true);
  if (wanted.exposure && values_.exposure != wanted.exposure)
    notes_.push_back(fmt::format("exposure was set to {}, but the device says {}", *wanted.exposure,
                                 values_.exposure ? fmt::format("{}", *values_.exposure)
                                                  : std::string("that it has no such setting")));
}

void OpenNi2Device::set_registration(bool on) {
  const auto mode = on ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR : openni::IMAGE_REGISTRATION_OFF;
  if (has_colour() && streams_->device.isImageRegistrationModeSupported(mode))
    streams_->device.setImageRegistrationMode(mode);
}

void OpenNi2Device::set_mirror(bool on) {
  streams_->depth.setMirroringEnabled(on);
  if (has_colour()) streams_->colour.setMirroringEnabled(on);
}

void OpenNi2Device::set_camera(const SensorValues& wanted) {
  openni::CameraSettings* camera = streams_->colour.getCameraSettings();
  if (camera == nullptr) return;
  if (wanted.auto_exposure) camera->setAutoExposureEnabled(*wanted.auto_exposure);
  if (wanted.exposure) camera->setExposure(*wanted.exposure);
  if (wanted.auto_white_balance) camera->setAutoWhiteBalanceEnabled(*wanted.auto_white_balance);
}

void OpenNi2Device::read_back() {
  values_ = {};
  if (has_colour() &&
      streams_->device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR))
    values_.registration =
        streams_->device.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  values_.mirror = truth(streams_->depth, openni::STREAM_PROPERTY_MIRRORING);
  if (!has_colour()) return;
  const std::optional<bool> colour_mirror = truth(streams_->colour, openni::STREAM_PROPERTY_MIRRORING);
  if (colour_mirror != values_.mirror)
    notes_.emplace_back("only one of depth and colour is mirrored: they do not fit together");
  values_.auto_exposure = truth(streams_->colour, openni::STREAM_PROPERTY_AUTO_EXPOSURE);
  values_.exposure = property<int>(streams_->colour, openni::STREAM_PROPERTY_EXPOSURE);
  values_.auto_white_balance = truth(streams_->colour, openni::STREAM_PROPERTY_AUTO_WHITE_BALANCE);
}

void OpenNi2Device::find_intrinsics() {
  const openni::VideoStream& seen_from =
      has_colour() && values_.registration.value_or(false) ? streams_->colour : streams_->depth;
  const auto horizontal = property<float>(seen_from, openni::STREAM_PROPERTY_HORIZONTAL_FOV);
  const auto vertical = property<float>(seen_from, openni::STREAM_PROPERTY_VERTICAL_FOV);
  const auto sensible = [](const std::optional<float>& angle) {
    return angle && *angle > 0.01F && *angle < 3.1F;
  };
  intrinsics_ = sensible(horizontal) && sensible(vertical)
                    ? Intrinsics::from_field_of_view(size_, *horizontal, *vertical, IntrinsicsOrigin::sensor)
                    : Intrinsics::guess_for(size_);
}

OpenNi2Device::Ready OpenNi2Device::wait(std::chrono::milliseconds timeout) {
  int index = -1;
  const openni::Status status = openni::OpenNI::waitForAnyStream(streams_->all, has_colour() ? 2 : 1, &index,
                                                                 static_cast<int>(timeout.count()));
  if (status != openni::STATUS_OK) return Ready::nothing;
  return index == 0 ? Ready::depth : Ready::colour;
}

Outcome OpenNi2Device::read_depth(cv::Mat1f& depth_mm, std::int64_t& time_us) {
  openni::VideoFrameRef frame;
  if (streams_->depth.readFrame(&frame) != openni::STATUS_OK) return Outcome::failure("it cannot be read");
  time_us = static_cast<std::int64_t>(frame.getTimestamp());
  const openni::PixelFormat format = frame.getVideoMode().getPixelFormat();
  if (format != openni::PIXEL_FORMAT_DEPTH_1_MM && format != openni::PIXEL_FORMAT_DEPTH_100_UM)
    return Outcome::failure("it is not depth in mm or 100 um");
  if (Outcome outcome = check_memory(frame, size_, 2); !outcome) return outcome;
  depth_from_units(as_image(frame, CV_16UC1), format == openni::PIXEL_FORMAT_DEPTH_1_MM ? 1.0 : 0.1,
                   depth_mm);
  return Outcome::success();
}

Outcome OpenNi2Device::read_colour(cv::Mat3b& colour, std::int64_t& time_us) {
  openni::VideoFrameRef frame;
  if (streams_->colour.readFrame(&frame) != openni::STATUS_OK) return Outcome::failure("it cannot be read");
  time_us = static_cast<std::int64_t>(frame.getTimestamp());
  if (frame.getVideoMode().getPixelFormat() != openni::PIXEL_FORMAT_RGB888)
    return Outcome::failure("it is not RGB");
  const cv::Size size(frame.getWidth(), frame.getHeight());
  if (Outcome outcome = check_memory(frame, size, 3); !outcome) return outcome;
  if (size == size_) {
    cv::cvtColor(as_image(frame, CV_8UC3), colour, cv::COLOR_RGB2BGR);
    return Outcome::success();
  }
  fit_colour(as_image(frame, CV_8UC3), size_, colour);
  cv::cvtColor(colour, colour, cv::COLOR_RGB2BGR);
  return Outcome::success();
}

}  // namespace saccade
