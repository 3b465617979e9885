#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "oni/jpeg.hpp"

namespace saccade {

/// A camera of the system through Video4Linux, streaming from its opening. Formats: YUYV, UYVY, NV12, BGR,
/// RGB, Motion JPEG and 8-bit grey, at 640x480 and 30 Hz or what the driver has nearest to it. Thread safety:
/// one call at a time.
class V4l2Camera {
 public:
  /// Throws std::runtime_error with the reason if the file is no camera that streams in one of the formats.
  explicit V4l2Camera(const std::filesystem::path& device);
  ~V4l2Camera();
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  cv::Size size() const { return size_; }
  double rate_hz() const { return rate_hz_; }  ///< as the driver reports it; 0 = unknown

  enum class Read {
    picture,
    timeout,
    damaged,  ///< incomplete, or no JPEG
  };

  /// Waits for the next picture (BGR, size()). Throws std::runtime_error with the reason if the camera is
  /// lost.
  Read read(cv::Mat3b& picture, std::chrono::milliseconds timeout);

 private:
  /// Memory of the driver that it fills with a picture.
  class Buffer {
   public:
    Buffer(int file, std::uint32_t offset, std::size_t size);
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    std::span<std::uint8_t> bytes() const { return bytes_; }

   private:
    std::span<std::uint8_t> bytes_;
  };

  void check_capabilities() const;
  void choose_format();
  void choose_rate();
  void start();
  void queue(std::uint32_t index) const;
  bool decode(std::span<std::uint8_t> data, cv::Mat3b& picture);

  struct CloseFile {
    int file;
    ~CloseFile();
  };

  CloseFile device_;
  std::uint32_t format_ = 0;  // V4L2_PIX_FMT_...
  std::size_t row_bytes_ = 0;
  cv::Size size_;
  double rate_hz_ = 0;
  std::vector<std::unique_ptr<Buffer>> buffers_;
  JpegCodec jpeg_;
};

}  // namespace saccade
