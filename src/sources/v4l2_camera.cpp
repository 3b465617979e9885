#include "sources/v4l2_camera.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include <opencv2/imgproc.hpp>

#include "core/image_size.hpp"

namespace saccade {
namespace {

constexpr std::uint32_t kBuffers = 4, kWidth = 640, kHeight = 480, kRateHz = 30;
constexpr std::uint32_t kCapture = V4L2_BUF_TYPE_VIDEO_CAPTURE;

// In the order in which they are tried: without losses first.
constexpr std::array<std::uint32_t, 8> kFormats = {V4L2_PIX_FMT_YUYV,  V4L2_PIX_FMT_UYVY,  V4L2_PIX_FMT_NV12,
                                                   V4L2_PIX_FMT_BGR24, V4L2_PIX_FMT_RGB24, V4L2_PIX_FMT_MJPEG,
                                                   V4L2_PIX_FMT_JPEG,  V4L2_PIX_FMT_GREY};

// 0, or the errno of the failure.
int control(int file, unsigned long request, void* argument) {
  while (::ioctl(file, request, argument) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

std::runtime_error failure(const std::string& what, int code) {
  return std::runtime_error(what + ": " + std::strerror(code));
}

void require(int code, const std::string& what) {
  if (code != 0) throw failure(what, code);
}

v4l2_buffer buffer_numbered(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

bool is_jpeg(std::uint32_t format) { return format == V4L2_PIX_FMT_MJPEG || format == V4L2_PIX_FMT_JPEG; }

int bytes_per_pixel(std::uint32_t format) {
  if (format == V4L2_PIX_FMT_BGR24 || format == V4L2_PIX_FMT_RGB24) return 3;
  return format == V4L2_PIX_FMT_YUYV || format == V4L2_PIX_FMT_UYVY ? 2 : 1;
}

}  // namespace

V4l2Camera::CloseFile::~CloseFile() {
  if (file >= 0) ::close(file);
}

V4l2Camera::Buffer::Buffer(int file, std::uint32_t offset, std::size_t size) {
  void* memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, offset);
  if (memory == MAP_FAILED) throw failure("its memory cannot be mapped", errno);
  bytes_ = {static_cast<std::uint8_t*>(memory), size};
}

V4l2Camera::Buffer::~Buffer() { ::munmap(bytes_.data(), bytes_.size()); }

V4l2Camera::V4l2Camera(const std::filesystem::path& device)
    : device_{::open(device.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)} {
  if (device_.file < 0) throw failure("it cannot be opened", errno);
  check_capabilities();
  choose_format();
  choose_rate();
  start();
}

V4l2Camera::~V4l2Camera() {
  std::uint32_t type = kCapture;
  control(device_.file, VIDIOC_STREAMOFF, &type);  // the camera may be gone
}

void V4l2Camera::check_capabilities() const {
  v4l2_capability able{};
  require(control(device_.file, VIDIOC_QUERYCAP, &able), "not a camera");
  const std::uint32_t flags =
      (able.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? able.device_caps : able.capabilities;
  if ((flags & V4L2_CAP_VIDEO_CAPTURE) == 0 || (flags & V4L2_CAP_STREAMING) == 0)
    throw std::runtime_error("the device does not stream pictures");
}

// A driver answers with what it has instead of what it was asked for.
void V4l2Camera::choose_format() {
  for (const std::uint32_t wanted : kFormats) {
    v4l2_format format{};
    format.type = kCapture;
    format.fmt.pix.width = kWidth;
    format.fmt.pix.height = kHeight;
    format.fmt.pix.pixelformat = wanted;
    format.fmt.pix.field = V4L2_FIELD_ANY;
    const int code = control(device_.file, VIDIOC_S_FMT, &format);
    if (code == EBUSY) throw failure("another program uses it", code);
    if (code != 0 || format.fmt.pix.pixelformat != wanted) continue;
    check_image_size(format.fmt.pix.width, format.fmt.pix.height);
    format_ = wanted;
    size_ = {static_cast<int>(format.fmt.pix.width), static_cast<int>(format.fmt.pix.height)};
    row_bytes_ =
        std::max<std::size_t>(format.fmt.pix.bytesperline,
                              format.fmt.pix.width * static_cast<std::size_t>(bytes_per_pixel(wanted)));
    return;
  }
  throw std::runtime_error("it has none of the known formats");
}

// Many drivers have one rate only and refuse to set it.
void V4l2Camera::choose_rate() {
  v4l2_streamparm rate{};
  rate.type = kCapture;
  rate.parm.capture.timeperframe = {1, kRateHz};
  control(device_.file, VIDIOC_S_PARM, &rate);
  rate = {};
  rate.type = kCapture;
  if (control(device_.file, VIDIOC_G_PARM, &rate) != 0) return;
  const v4l2_fract& period = rate.parm.capture.timeperframe;
  if (period.numerator > 0) rate_hz_ = static_cast<double>(period.denominator) / period.numerator;
}

void V4l2Camera::start() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = kCapture;
  request.memory = V4L2_MEMORY_MMAP;
  require(control(device_.file, VIDIOC_REQBUFS, &request), "it has no memory for pictures");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = buffer_numbered(i);
    require(control(device_.file, VIDIOC_QUERYBUF, &buffer), "it has no memory for pictures");
    buffers_.push_back(std::make_unique<Buffer>(device_.file, buffer.m.offset, buffer.length));
    queue(i);
  }
  std::uint32_t type = kCapture;
  require(control(device_.file, VIDIOC_STREAMON, &type), "it does not start");
}

void V4l2Camera::queue(std::uint32_t index) const {
  v4l2_buffer buffer = buffer_numbered(index);
  require(control(device_.file, VIDIOC_QBUF, &buffer), "it takes no memory for pictures");
}

V4l2Camera::Read V4l2Camera::read(cv::Mat3b& picture, std::chrono::milliseconds timeout) {
  pollfd waiting{device_.file, POLLIN, 0};
  const int ready = ::poll(&waiting, 1, static_cast<int>(timeout.count()));
  if (ready == 0 || (ready < 0 && errno == EINTR)) return Read::timeout;
  if (ready < 0) throw failure("it cannot be waited for", errno);
  if ((waiting.revents & POLLIN) == 0) throw std::runtime_error("the driver reports an error");
  v4l2_buffer filled = buffer_numbered(0);
  const int code = control(device_.file, VIDIOC_DQBUF, &filled);
  if (code == EAGAIN) return Read::timeout;
  require(code, "it gives no pictures");
  if (filled.index >= buffers_.size()) throw std::runtime_error("the driver gives unknown memory");
  const std::span<std::uint8_t> memory = buffers_[filled.index]->bytes();
  const bool is_whole = (filled.flags & V4L2_BUF_FLAG_ERROR) == 0 && filled.bytesused <= memory.size();
  const bool is_good = is_whole && decode(memory.first(filled.bytesused), picture);
  queue(filled.index);
  return is_good ? Read::picture : Read::damaged;
}

bool V4l2Camera::decode(std::span<std::uint8_t> data, cv::Mat3b& picture) {
  // Many cameras write JPEG of which the library warns, e.g. with bytes after the end; the picture is good.
  if (is_jpeg(format_)) return static_cast<bool>(jpeg_.decode(data, size_, picture, JpegWarning::is_ignored));
  const auto rows =
      static_cast<std::size_t>(format_ == V4L2_PIX_FMT_NV12 ? size_.height * 3 / 2 : size_.height);
  if (data.size() < rows * row_bytes_) return false;
  const cv::Mat raw(static_cast<int>(rows), size_.width, CV_8UC(bytes_per_pixel(format_)), data.data(),
                    row_bytes_);
  switch (format_) {
    case V4L2_PIX_FMT_YUYV:
      cv::cvtColor(raw, picture, cv::COLOR_YUV2BGR_YUYV);
      break;
    case V4L2_PIX_FMT_UYVY:
      cv::cvtColor(raw, picture, cv::COLOR_YUV2BGR_UYVY);
      break;
    case V4L2_PIX_FMT_NV12:
      cv::cvtColor(raw, picture, cv::COLOR_YUV2BGR_NV12);
      break;
    case V4L2_PIX_FMT_RGB24:
      cv::cvtColor(raw, picture, cv::COLOR_RGB2BGR);
      break;
    case V4L2_PIX_FMT_GREY:
      cv::cvtColor(raw, picture, cv::COLOR_GRAY2BGR);
      break;
    default:
      raw.copyTo(picture);
  }
  return true;
}

}  // namespace saccade
