#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "core/outcome.hpp"

namespace saccade {

/// The size that a JPEG image of 1 or 3 components declares (baseline, extended or progressive); std::nullopt
/// for other data.
std::optional<cv::Size> jpeg_size(std::span<const std::uint8_t> payload);

/// What a warning of the library means, for example of bytes after the end.
enum class JpegWarning { is_damage, is_ignored };

/// Decodes and encodes the JPEG images of a recording (README 4.4) with libjpeg-turbo. Keeps its state
/// between images. Thread safety: one call at a time per object.
class JpegCodec {
 public:
  JpegCodec();
  ~JpegCodec();
  JpegCodec(const JpegCodec&) = delete;
  JpegCodec& operator=(const JpegCodec&) = delete;

  /// Decodes into `image` (BGR, reused if it fits). The size and the number of components are checked before
  /// anything is allocated. Fails for another size than `size`, for anything but a JPEG of 1 or 3 components,
  /// and for damaged or truncated data.
  Outcome decode(std::span<const std::uint8_t> payload, cv::Size size, cv::Mat3b& image,
                 JpegWarning warning = JpegWarning::is_damage);

  /// Appends `image` (BGR, not empty) as a baseline JPEG with 4:2:0 chroma. quality: 1..100. Throws Error
  /// (failed) if the library fails.
  void encode(const cv::Mat3b& image, int quality, std::vector<std::uint8_t>& payload);

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace saccade
