#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// The header of a PNG file.
struct PngHeader {
  cv::Size size;
  int bits = 0;          ///< per sample: 1, 2, 4, 8 or 16
  std::string channels;  ///< "grey", "grey+alpha", "RGB", "RGBA" or "palette"
};

/// Throws std::runtime_error with the reason if the bytes are no PNG or check_image_size() refuses it.
[[nodiscard]] PngHeader read_png_header(std::span<const std::uint8_t> png);

/// Decodes grey PNGs of 8 or 16 bits as they are (CV_8UC1, CV_16UC1), palette images as their 8-bit indices,
/// and colour images as 8-bit BGR (CV_8UC3). Throws std::runtime_error with the reason, also for a truncated
/// file and, before it allocates memory, for an image that check_image_size() refuses.
[[nodiscard]] cv::Mat decode_png(std::span<const std::uint8_t> png);

/// Encodes CV_8UC1, CV_16UC1 or CV_8UC3 (BGR) at a fast compression level. The same image gives the same
/// bytes. Throws std::invalid_argument for another type.
[[nodiscard]] std::vector<std::uint8_t> encode_png(const cv::Mat& image);

}  // namespace saccade
