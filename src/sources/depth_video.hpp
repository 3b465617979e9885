#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <opencv2/core.hpp>

namespace saccade {

/// Keeps OpenCV's video libraries from writing to standard error; what they have to say comes as an Error.
void quieten_video_libraries();

/// A stream of 16-bit depth images by a route that gives them bit for bit. Decoding a video in the ordinary
/// way makes 8 bits of 16, which is never right for depth.
class DepthVideo {
 public:
  virtual ~DepthVideo() = default;

  cv::Size size() const { return size_; }
  double rate_hz() const { return rate_hz_; }  ///< nominal, > 0

  /// Reads the next image; `time_us` is that of the container where the route can tell, else that of the
  /// nominal rate. False at the end. Throws std::runtime_error with the reason if this image is damaged; the
  /// next may be good.
  virtual bool read(cv::Mat1w& depth, std::int64_t& time_us) = 0;

  /// Leaves an image out. False at the end.
  virtual bool skip() = 0;

 protected:
  cv::Size size_;
  double rate_hz_ = 30;
};

/// Opens a video file of depth: FFV1 of 16-bit gray in Matroska, or packets that are 16-bit gray PNGs or
/// uncompressed gray16le (.nut, Matroska, .mov). nullptr if it holds 8-bit video. Throws Error (unreadable):
/// no video, or one of 16 bits that could only be read with 8; it says what to try.
std::unique_ptr<DepthVideo> open_depth_video(const std::filesystem::path& path);

/// Opens numbered 16-bit PNGs, e.g. "depth_%04d.png". Throws Error (unreadable): none found, or not of 16-bit
/// gray.
std::unique_ptr<DepthVideo> open_depth_images(const std::string& pattern);

}  // namespace saccade
