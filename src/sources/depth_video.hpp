#pragma once

#include <cstdint>
#include <memory>

#include <opencv2/core.hpp>

#include "sources/video_file.hpp"

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

/// Whether the stream of a file from which nothing was read holds depth: FFV1 of 16-bit grey, 16-bit grey
/// PNGs, or uncompressed 16-bit grey. Throws Error (unreadable): it has no images, or 16 bits in a codec that
/// does not keep them.
bool holds_depth(VideoFile& file);

/// The depth of a file for which holds_depth() is true. Throws Error (unreadable) as that, or if the codec
/// refuses the header.
std::unique_ptr<DepthVideo> open_depth_video(std::unique_ptr<VideoFile> file);

}  // namespace saccade
