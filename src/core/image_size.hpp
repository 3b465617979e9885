#pragma once

#include <cstdint>

namespace saccade {

/// The largest images that are accepted, in px. They bound the memory and the time that a hostile file can
/// take.
inline constexpr int kLargestSide = 8192;
inline constexpr std::int64_t kMostPixels = 16'000'000;  ///< of one image; the same as in a recording

/// Throws std::runtime_error with the reason, e.g. "9000x8 is larger than 8192 pixels a side", if an image is
/// larger in either respect. Call it before memory is allocated for the image.
void check_image_size(std::int64_t width, std::int64_t height);

}  // namespace saccade
