#include "core/fit_colour.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

cv::Mat3b row_of(std::initializer_list<int> values) {
  cv::Mat3b image(1, static_cast<int>(values.size()));
  int col = 0;
  for (const int value : values) image(0, col++) = cv::Vec3b::all(static_cast<std::uint8_t>(value));
  return image;
}

TEST(FitColour, ALargerImageIsAveraged) {
  cv::Mat3b fitted;
  fit_colour(row_of({0, 10, 100, 200}), {2, 1}, fitted);
  EXPECT_EQ(fitted(0, 0)[0], 5);
  EXPECT_EQ(fitted(0, 1)[0], 150);
}

// At a quarter and three quarters of the way between the centres of the pixels; beyond them, the border.
TEST(FitColour, ASmallerImageIsInterpolated) {
  cv::Mat3b fitted;
  fit_colour(row_of({0, 100}), {4, 1}, fitted);
  for (const auto& [col, value] : {std::pair{0, 0}, {1, 25}, {2, 75}, {3, 100}})
    EXPECT_EQ(fitted(0, col)[0], value) << col;
}

TEST(FitColour, OneOfTheSameSizeIsCopied) {
  const cv::Mat3b image = row_of({1, 2, 3});
  cv::Mat3b fitted;
  fit_colour(image, {3, 1}, fitted);
  EXPECT_EQ(cv::norm(image, fitted, cv::NORM_INF), 0);
  EXPECT_NE(image.data, fitted.data);
}

}  // namespace
}  // namespace saccade
