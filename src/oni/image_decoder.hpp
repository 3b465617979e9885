#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "core/outcome.hpp"
#include "oni/codec_16z.hpp"
#include "oni/format.hpp"
#include "oni/jpeg.hpp"
#include "oni/properties.hpp"

namespace saccade {

/// Decodes the payloads of frames into images (README 4). It decodes a payload only if its size can hold the
/// image, so that no number in the file alone decides how much memory is allocated. Keeps scratch memory
/// between frames. Thread safety: one call at a time per object.
class OniImageDecoder {
 public:
  /// The stored numbers of a depth frame (1 mm, 100 um or raw shifts), in the full image size; pixels outside
  /// the crop are 0. `depth` is reused if it fits. Fails for a bad frame, and `depth` is then undefined.
  Outcome decode_depth(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload,
                       cv::Mat1w& depth);

  /// A colour, grey or infrared frame as BGR, in the full image size; pixels outside the crop are black.
  /// 16-bit grey is scaled from 10 bits, the range of PrimeSense's infrared cameras; larger values are white.
  /// Fails for a bad frame, and `image` is then undefined.
  Outcome decode_colour(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload,
                        cv::Mat3b& image);

 private:
  Outcome decode_colour_part(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload,
                             cv::Mat3b& part);
  Outcome decode_pixels(OniCodec codec, const OniFormat& format, std::span<const std::uint8_t> payload);
  Outcome decode_16z(Codec16z codec, const OniFormat& format, std::span<const std::uint8_t> payload);
  Outcome decode_full_16z(Codec16z codec, cv::Size size, std::span<const std::uint8_t> payload,
                          cv::Mat1w& depth);

  Decoder16z decoder_16z_;
  JpegCodec jpeg_;
  std::vector<std::uint8_t> pixels_;  // of one frame, rows packed
  cv::Rect place_;                    // their rectangle in the image
  cv::Mat3b part_;
};

/// Converts stored numbers to depth in mm, rows x cols as `stored`, 0 = no reading, which 65535 becomes too,
/// as in every 16-bit depth image. `shift_to_depth_mm` is the value of the property S2D (u16 in mm for each
/// raw shift) and applies to the shift formats only; a shift outside the table, or without a table, is no
/// reading.
void depth_to_mm(const cv::Mat1w& stored, OniPixelFormat format,
                 std::optional<std::span<const std::uint8_t>> shift_to_depth_mm, cv::Mat1f& depth_mm);

}  // namespace saccade
