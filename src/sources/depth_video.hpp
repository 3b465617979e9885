#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

namespace saccade {

/// Keeps OpenCV's video libraries from writing to standard error; their failures come as an Error.
void quieten_video_libraries();

/// A stream of 16-bit depth images in mm, 0 = no reading, by a route that keeps every bit. Decoding a video
/// in the ordinary way reduces 16 bits to 8, which is never right for depth.
class DepthVideo {
 public:
  virtual ~DepthVideo() = default;

  cv::Size size() const { return size_; }
  double rate_hz() const { return rate_hz_; }  ///< nominal, > 0

  /// Reads the next image; `time_us` is that of the container where the route gives it, else that of the
  /// nominal rate. False at the end. Throws std::runtime_error with the reason if this image is damaged; the
  /// next may be good.
  [[nodiscard]] virtual bool read(cv::Mat1w& depth, std::int64_t& time_us) = 0;

  /// Skips an image. False at the end.
  [[nodiscard]] virtual bool skip() = 0;

 protected:
  cv::Size size_;
  double rate_hz_ = 30;
};

/// Opens a video file of depth: FFV1 of 16-bit grey in Matroska, or packets that are 16-bit grey PNGs or
/// uncompressed gray16le (.nut, Matroska, .mov). nullptr if it holds 8-bit video. Throws Error (unreadable):
/// not a video, or 16 bits that could only be read as 8.
std::unique_ptr<DepthVideo> open_depth_video(const std::filesystem::path& path);

/// Opens numbered 16-bit PNGs, e.g. "depth_%04d.png". Throws Error (unreadable): there are none, or they are
/// not 16-bit grey.
std::unique_ptr<DepthVideo> open_depth_images(const std::string& pattern);

}  // namespace saccade
