#pragma once

#include <cstdint>
#include <span>

#include <opencv2/core.hpp>

namespace saccade {

/// Decodes an image compressed with RVL (A. Wilson, "Fast lossless depth image compression", ISS 2017) into
/// `depth`, whose size says how many pixels there are. In turns: a number of zeros, a number of others, and
/// of each of these the difference to the one before it, with its sign in the lowest bit. A number is a row
/// of groups of 4 bits, the lowest first, of which the highest bit says that another follows; eight groups
/// are a little-endian word, from its highest bits down. Throws std::runtime_error if the data end early or
/// hold more pixels.
void decode_rvl(std::span<const std::uint8_t> data, cv::Mat1w& depth);

}  // namespace saccade
