#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// Encodes CV_32FC1 or CV_32FC3 as an uncompressed little-endian TIFF 6.0 of 32-bit floats, one strip,
/// samples in their order in memory. The same image gives the same bytes. Throws std::invalid_argument for
/// another type, or an empty image.
[[nodiscard]] std::vector<std::uint8_t> encode_tiff(const cv::Mat& image);

}  // namespace saccade
