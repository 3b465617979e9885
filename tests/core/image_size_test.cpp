#include "core/image_size.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(ImageSize, SidesAndPixelsAreBounded) {
  for (const auto& [width, height] : {std::pair(8192, 1), {1, 8192}, {4000, 4000}, {8192, 1953}})
    EXPECT_NO_THROW(check_image_size(width, height)) << width << ' ' << height;
  for (const auto& [width, height] :
       {std::pair(8193, 1), {1, 8193}, {4001, 4000}, {4000, 4001}, {8192, 1954}})
    EXPECT_THROW(check_image_size(width, height), std::runtime_error) << width << ' ' << height;
  EXPECT_THROW(check_image_size(std::int64_t{1} << 62, 4), std::runtime_error) << "whose product overflows";
}

}  // namespace
}  // namespace saccade
