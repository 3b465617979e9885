#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include <opencv2/core.hpp>

namespace saccade {

/// A video of 16-bit depth images in mm, 0 = no reading, decoded by a route that keeps every bit.
class DepthVideo {
 public:
  virtual ~DepthVideo() = default;

  virtual cv::Size size() const = 0;
  virtual double rate_hz() const = 0;  ///< nominal, > 0

  /// Whether damage of the images can be noticed: the codec or the container has checksums.
  virtual bool has_checksums() const = 0;

  /// Reads the next image; `time_us` is that of the container, from its first image. False at the end. Throws
  /// std::runtime_error with the reason if this image is damaged or lost; the next may be good.
  [[nodiscard]] virtual bool read(cv::Mat1w& depth, std::int64_t& time_us) = 0;

  /// Skips an image. False at the end.
  [[nodiscard]] virtual bool skip() = 0;
};

/// Opens a video file of depth: FFV1 of 16-bit grey, 16-bit grey PNGs, or uncompressed 16-bit grey; `title`
/// as in VideoFile. nullptr if it holds 8-bit video. Throws Error (unreadable): not a video, images that
/// check_image_size() refuses, or 16 bits in a codec that does not keep them.
std::unique_ptr<DepthVideo> open_depth_video(const std::filesystem::path& path, std::string_view title = {});

}  // namespace saccade
