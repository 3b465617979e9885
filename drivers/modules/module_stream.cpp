#include "drivers/modules/module_stream.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace saccade {
namespace {

bool same(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY &&
         a.fps == b.fps;
}

// Copies a row from right to left.
template <typename Pixel>
void copy_reversed(const cv::Mat& image, int row, int first, int count, void* to) {
  const auto* from = image.ptr<Pixel>(row) + first;
  std::reverse_copy(from, from + count, static_cast<Pixel*>(to));
}

}  // namespace

int bytes_per_pixel(OniPixelFormat format) {
  switch (format) {
    case ONI_PIXEL_FORMAT_DEPTH_1_MM:
    case ONI_PIXEL_FORMAT_GRAY16:
      return 2;
    case ONI_PIXEL_FORMAT_RGB888:
      return 3;
    default:
      return 0;
  }
}

std::vector<OniVideoMode> video_modes(OniPixelFormat format, const std::vector<cv::Size>& sizes,
                                      const std::vector<int>& rates) {
  std::vector<OniVideoMode> modes;
  for (const cv::Size& size : sizes)
    for (const int rate : rates) modes.push_back({format, size.width, size.height, rate});
  return modes;
}

ModuleStream::ModuleStream(StreamKind kind, const std::function<FieldOfView()>& field_of_view,
                           std::function<bool(bool)> running)
    : kind_(std::move(kind)), running_(std::move(running)) {
  settings_.mode = kind_.modes.front();
  properties_.add<OniVideoMode>(
      ONI_STREAM_PROPERTY_VIDEO_MODE, [this] { return settings().mode; },
      [this](const OniVideoMode& mode) { return set_mode(mode); });
  properties_.add<OniCropping>(
      ONI_STREAM_PROPERTY_CROPPING, [this] { return settings().cropping; },
      [this](const OniCropping& cropping) { return set_cropping(cropping); });
  properties_.add<OniBool>(
      ONI_STREAM_PROPERTY_MIRRORING, [this]() -> OniBool { return settings().mirrored ? TRUE : FALSE; },
      [this](const OniBool& mirrored) {
        const std::lock_guard lock(settings_mutex_);
        settings_.mirrored = mirrored != FALSE;
        return ONI_STATUS_OK;
      });
  properties_.add<float>(ONI_STREAM_PROPERTY_HORIZONTAL_FOV,
                         [=] { return static_cast<float>(field_of_view().horizontal_rad); });
  properties_.add<float>(ONI_STREAM_PROPERTY_VERTICAL_FOV,
                         [=] { return static_cast<float>(field_of_view().vertical_rad); });
  properties_.add<int>(ONI_STREAM_PROPERTY_STRIDE, [this] { return stride(); });
  if (kind_.sensor == ONI_SENSOR_DEPTH) {
    properties_.add<int>(ONI_STREAM_PROPERTY_MAX_VALUE, [this] { return kind_.largest_value; });
    properties_.add<int>(ONI_STREAM_PROPERTY_MIN_VALUE, [] { return 0; });
  }
}

StreamSettings ModuleStream::settings() const {
  const std::lock_guard lock(settings_mutex_);
  return settings_;
}

bool ModuleStream::started() const {
  const std::lock_guard lock(settings_mutex_);
  return started_;
}

OniStatus ModuleStream::set_mode(const OniVideoMode& mode) {
  if (std::none_of(kind_.modes.begin(), kind_.modes.end(), [&](const auto& m) { return same(m, mode); }))
    return ONI_STATUS_NOT_SUPPORTED;
  const std::lock_guard lock(settings_mutex_);
  settings_.mode = mode;
  settings_.cropping = {};  // it was meant for the other size
  return ONI_STATUS_OK;
}

OniStatus ModuleStream::set_cropping(const OniCropping& cropping) {
  const std::lock_guard lock(settings_mutex_);
  const cv::Rect whole(0, 0, settings_.mode.resolutionX, settings_.mode.resolutionY);
  const cv::Rect wanted(cropping.originX, cropping.originY, cropping.width, cropping.height);
  if (cropping.enabled && (wanted.empty() || (wanted & whole) != wanted)) return ONI_STATUS_BAD_PARAMETER;
  settings_.cropping = cropping;
  return ONI_STATUS_OK;
}

int ModuleStream::stride() const {
  const StreamSettings now = settings();
  return (now.cropping.enabled ? now.cropping.width : now.mode.resolutionX) *
         bytes_per_pixel(now.mode.pixelFormat);
}

int ModuleStream::getRequiredFrameSize() {
  int largest = 0;
  for (const OniVideoMode& mode : kind_.modes)
    largest = std::max(largest, mode.resolutionX * mode.resolutionY * bytes_per_pixel(mode.pixelFormat));
  return largest;
}

OniStatus ModuleStream::convertDepthToColorCoordinates(StreamBase* colour, int depth_x, int depth_y,
                                                       OniDepthPixel, int* colour_x, int* colour_y) {
  const auto* other = dynamic_cast<const ModuleStream*>(colour);
  if (other == nullptr) return ONI_STATUS_BAD_PARAMETER;
  const OniVideoMode from = settings().mode, to = other->settings().mode;
  *colour_x = depth_x * to.resolutionX / from.resolutionX;
  *colour_y = depth_y * to.resolutionY / from.resolutionY;
  return ONI_STATUS_OK;
}

OniStatus ModuleStream::start() {
  if (exchange_started(true)) return ONI_STATUS_OK;
  if (running_(true)) return ONI_STATUS_OK;
  exchange_started(false);
  return ONI_STATUS_ERROR;
}

void ModuleStream::stop() {
  if (!exchange_started(false)) return;
  { const std::lock_guard until_delivered(delivery_mutex_); }
  running_(false);
}

bool ModuleStream::exchange_started(bool started) {
  const std::lock_guard lock(settings_mutex_);
  return std::exchange(started_, started);
}

void ModuleStream::deliver(const cv::Mat& image, int index, std::uint64_t timestamp_us, int missing_bytes) {
  const std::lock_guard delivery(delivery_mutex_);
  if (!started()) return;
  const StreamSettings now = settings();
  if (image.cols != now.mode.resolutionX || image.rows != now.mode.resolutionY) return;
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;  // the clients hold all frames that there are
  frame->sensorType = kind_.sensor;
  frame->videoMode = now.mode;
  frame->frameIndex = index;
  frame->timestamp = timestamp_us;
  fill(*frame, image, now);
  frame->dataSize -= std::min(missing_bytes, frame->dataSize);
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

void ModuleStream::fill(OniFrame& out, const cv::Mat& image, const StreamSettings& now) const {
  const OniCropping& crop = now.cropping;
  const cv::Rect part = crop.enabled ? cv::Rect(crop.originX, crop.originY, crop.width, crop.height)
                                     : cv::Rect({}, image.size());
  const int pixel = bytes_per_pixel(now.mode.pixelFormat);
  out.width = part.width;
  out.height = part.height;
  out.croppingEnabled = crop.enabled;
  out.cropOriginX = part.x;
  out.cropOriginY = part.y;
  out.stride = part.width * pixel;
  out.dataSize = out.stride * part.height;
  auto* to = static_cast<std::uint8_t*>(out.data);
  for (int row = part.y; row < part.y + part.height; ++row, to += out.stride) {
    const int mirrored_first = image.cols - part.x - part.width;
    if (!now.mirrored)
      std::memcpy(to, image.ptr(row) + part.x * pixel, static_cast<std::size_t>(out.stride));
    else if (pixel == 2)
      copy_reversed<std::uint16_t>(image, row, mirrored_first, part.width, to);
    else
      copy_reversed<cv::Vec3b>(image, row, mirrored_first, part.width, to);
  }
}

}  // namespace saccade
