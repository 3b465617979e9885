#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// Decodes and encodes the JPEG images of a recording with libjpeg-turbo. Keeps its tables between images.
/// Thread safety: one call at a time per object.
class JpegCodec {
 public:
  JpegCodec();
  ~JpegCodec();
  JpegCodec(const JpegCodec&) = delete;
  JpegCodec& operator=(const JpegCodec&) = delete;

  /// Decodes into `image` (BGR, reused if it fits). The size and the number of components are checked before
  /// anything is allocated. Returns why the image is bad: another size than `size`, no JPEG of 1 or 3
  /// components, damaged or cut data (a warning of the library counts); empty = it is good.
  std::string decode(std::span<const std::uint8_t> payload, cv::Size size, cv::Mat3b& image);

  /// Appends `image` (BGR) as a baseline JPEG with 4:2:0 chroma. quality: 1..100.
  void encode(const cv::Mat3b& image, int quality, std::vector<std::uint8_t>& payload);

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace saccade
