#include "models/colour_opponency.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace saccade {
namespace {

struct Opponency {
  double red_green = 0, blue_yellow = 0;
};

// The article's equations for one pixel, in double.
Opponency slow_opponency(double b, double g, double r, double least) {
  const double intensity = (b + g + r) / 3 / 255;
  if (intensity <= least) return {};
  b /= 255 * intensity, g /= 255 * intensity, r /= 255 * intensity;
  const double red = std::max(0.0, r - (g + b) / 2), green = std::max(0.0, g - (r + b) / 2);
  const double blue = std::max(0.0, b - (r + g) / 2);
  const double yellow = std::max(0.0, (r + g) / 2 - std::abs(r - g) / 2 - b);
  return {red - green, blue - yellow};
}

// Widths that leave a rest in vectors of any size.
TEST(ColourOpponency, IsThatOfTheSlowForm) {
  std::mt19937 random(3);
  for (const std::size_t width : {1U, 7U, 16U, 67U, 640U}) {
    std::vector<std::uint8_t> bgr[3];
    for (auto& channel : bgr)
      for (std::size_t c = 0; c < width; ++c)
        channel.push_back(static_cast<std::uint8_t>(random() % 4 == 0 ? random() % 16 : random() % 256));
    const ColourRows rows{bgr[0].data(), bgr[1].data(), bgr[2].data()};
    std::vector<float> intensity(width + 1, -1), red_green = intensity, blue_yellow = intensity;
    const float largest = find_intensity(rows, intensity.data(), width);
    const float least = 0.1F;
    find_opponency(rows, intensity.data(), least, red_green.data(), blue_yellow.data(), width);
    double slow_largest = 0;
    for (std::size_t c = 0; c < width; ++c) {
      const double b = bgr[0][c], g = bgr[1][c], r = bgr[2][c];
      EXPECT_NEAR(static_cast<double>(intensity[c]), (b + g + r) / 765, 1e-6) << width << ' ' << c;
      slow_largest = std::max(slow_largest, (b + g + r) / 765);
      const Opponency slow = slow_opponency(b, g, r, static_cast<double>(least));
      EXPECT_NEAR(static_cast<double>(red_green[c]), slow.red_green, 1e-5) << width << ' ' << c;
      EXPECT_NEAR(static_cast<double>(blue_yellow[c]), slow.blue_yellow, 1e-5) << width << ' ' << c;
    }
    EXPECT_NEAR(static_cast<double>(largest), slow_largest, 1e-6);
    EXPECT_EQ(intensity[width], -1);  // not beyond the row
    EXPECT_EQ(red_green[width], -1);
    EXPECT_EQ(blue_yellow[width], -1);
  }
}

TEST(ColourOpponency, IsNothingInTheDark) {
  const std::vector<std::uint8_t> zero(20, 0);
  std::vector<float> intensity(20, -1), red_green = intensity, blue_yellow = intensity;
  const ColourRows rows{zero.data(), zero.data(), zero.data()};
  EXPECT_EQ(find_intensity(rows, intensity.data(), 20), 0);
  find_opponency(rows, intensity.data(), 0, red_green.data(), blue_yellow.data(), 20);
  EXPECT_EQ(red_green, std::vector<float>(20, 0));
  EXPECT_EQ(blue_yellow, std::vector<float>(20, 0));
}

}  // namespace
}  // namespace saccade
