#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "oni/codec_16z.hpp"
#include "oni/format.hpp"
#include "oni/jpeg.hpp"
#include "oni/properties.hpp"

namespace saccade {

/// Turns the payloads of frames into images. A payload is decoded only if its size can hold the image, so no
/// memory is taken because of a number in the file alone. Keeps scratch memory between frames.
/// Thread safety: one call at a time per object.
class OniImageDecoder {
 public:
  /// The pixels of a depth frame as they are stored (1 mm, 100 um or raw shifts), in the full image size;
  /// what cropping left out is 0. `depth` is reused if it fits. Returns why the frame is bad, empty = it is
  /// good.
  std::string decode_depth(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload,
                           cv::Mat1w& depth);

  /// A colour, grey or infrared frame as BGR, in the full image size; what cropping left out is black.
  /// 16-bit grey is taken as 10-bit, as PrimeSense's infrared cameras give it; brighter is white.
  std::string decode_colour(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload,
                            cv::Mat3b& image);

 private:
  std::string decode_pixels(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload);
  std::string decode_16z(Codec16z codec, const OniFormat& format, std::span<const std::uint8_t> payload);

  std::string decode_whole_16z(Codec16z codec, cv::Size size, std::span<const std::uint8_t> payload,
                               cv::Mat1w& depth);

  Decoder16z decoder_16z_;
  JpegCodec jpeg_;
  std::vector<std::uint8_t> pixels_;  // of one frame, rows packed
  cv::Rect place_;                    // where they belong in the image
  cv::Mat3b part_;
};

/// Depth in mm, rows x cols as `stored`, 0 = no reading. `shift_to_depth_mm` is the table of raw shifts (the
/// S2D property, u16 each), used for shift formats only; a shift beyond it, or without a table, is no
/// reading.
void depth_to_mm(const cv::Mat1w& stored, OniPixelFormat format,
                 std::optional<std::span<const std::uint8_t>> shift_to_depth_mm, cv::Mat1f& depth_mm);

}  // namespace saccade
