#include "core/image_size.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace saccade {

void check_image_size(std::int64_t width, std::int64_t height) {
  if (width > kLargestSide || height > kLargestSide)
    throw std::runtime_error(
        fmt::format("{}x{} is larger than {} pixels a side", width, height, kLargestSide));
  if (width * height > kMostPixels)
    throw std::runtime_error(
        fmt::format("{}x{} has more than {} megapixels", width, height, kMostPixels / 1'000'000));
}

}  // namespace saccade
