#include "core/depth_units.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace saccade {
namespace {

// 1, 2, .., 65534 and then the two values of "no reading".
cv::Mat1w every_value() {
  cv::Mat1w stored(256, 256);
  for (int i = 0; i < 65536; ++i) stored(i / 256, i % 256) = static_cast<std::uint16_t>(i + 1);
  return stored;
}

TEST(DepthUnits, EveryReadingIsItsMultipleOfTheUnitAndComesBack) {
  for (const double unit_mm : {1.0, 0.1, 0.2, 5.0}) {
    cv::Mat1f depth;
    depth_from_units(every_value(), unit_mm, depth);
    for (int i = 1; i <= 65534; ++i)
      ASSERT_EQ(depth((i - 1) / 256, (i - 1) % 256), static_cast<float>(i * unit_mm)) << i;
    EXPECT_EQ(depth(255, 254), 0) << "65535 is no reading";
    EXPECT_EQ(depth(255, 255), 0);
    cv::Mat1w again;
    const DepthLosses losses = depth_to_units(depth, unit_mm, again);
    EXPECT_EQ(losses.rounded_pixels, 0);
    EXPECT_EQ(losses.out_of_range_pixels, 0);
    cv::Mat1w expected = every_value();
    expected(255, 254) = 0;
    EXPECT_EQ(cv::countNonZero(again != expected), 0) << unit_mm;
  }
}

TEST(DepthUnits, WhatAUnitCannotHoldIsCounted) {
  const cv::Mat1f depth = (cv::Mat1f(1, 6) << 0.4F, 0.6F, 1000.25F, 65534.4F, 65534.6F, 1e9F);
  cv::Mat1w stored;
  const DepthLosses losses = depth_to_units(depth, 1, stored);
  EXPECT_EQ(cv::countNonZero(stored != (cv::Mat1w(1, 6) << 0, 1, 1000, 65534, 0, 0)), 0);
  EXPECT_EQ(losses.out_of_range_pixels, 3) << "65535 would be no reading";
  EXPECT_EQ(losses.rounded_pixels, 3);
  EXPECT_NEAR(losses.largest_rounding_mm, 0.4, 0.01);
}

TEST(DepthUnits, RealNumbersThatAreNoLengthAreNoReading) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const cv::Mat1f metres = (cv::Mat1f(1, 6) << 1.5F, 0, -1, kInfinity, -kInfinity, std::nanf(""));
  cv::Mat1f depth;
  depth_from_reals(metres, 1000, depth);
  EXPECT_EQ(cv::countNonZero(depth != (cv::Mat1f(1, 6) << 1500, 0, 0, 0, 0, 0)), 0);
}

TEST(DepthUnits, TheUnitForAFrameReachesAQuarterBeyondIt) {
  EXPECT_EQ(unit_for(cv::Mat1f(2, 2, 1000.0F)), 1) << "whole millimetres";
  for (const auto& [farthest, unit] :
       {std::pair(5242.5F, 0.1), std::pair(5243.5F, 0.2), std::pair(10485.3F, 0.2), std::pair(10486.5F, 1.0)})
    EXPECT_EQ(unit_for(cv::Mat1f(2, 2, farthest)), unit) << farthest;
}

}  // namespace
}  // namespace saccade
