#include "ui/session/map_difference.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(MapDifference, OrangeWhereAIsStrongerBlueWhereBIs) {
  cv::Mat1f a(1, 3, 0.0F), b(1, 3, 0.0F);
  a(0, 0) = 2;
  b(0, 2) = 1;
  const MapDifference difference = map_difference(a, b);
  EXPECT_EQ(difference.largest, 2);
  cv::Mat3b picture(1, 3, cv::Vec3b(100, 100, 100));
  blend_difference(picture, difference, 1);
  EXPECT_EQ(picture(0, 0), difference_colour(1));
  EXPECT_EQ(picture(0, 1), cv::Vec3b(100, 100, 100));
  EXPECT_GT(picture(0, 2)[0], 180) << "blue, for half of the largest difference";
  EXPECT_NE(picture(0, 2), difference_colour(-1));
}

TEST(MapDifference, EqualMapsLeaveThePicture) {
  const cv::Mat1f map(2, 2, 3.0F);
  cv::Mat3b picture(2, 2, cv::Vec3b(1, 2, 3));
  blend_difference(picture, map_difference(map, map), 1);
  EXPECT_EQ(picture(1, 1), cv::Vec3b(1, 2, 3));
  EXPECT_THROW(map_difference(map, cv::Mat1f(1, 1, 0.0F)), std::invalid_argument);
}

}  // namespace
}  // namespace saccade
