#include "saliency/reference.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(Reference, HalveKeepsEvenInvalidPixelsInvalidAndAveragesOnlyValidOnes) {
  cv::Mat1d depth(9, 9, 1000.0);
  depth(4, 4) = 0;
  depth(2, 3) = 0;
  const cv::Mat1d half = reference::halve(depth);
  ASSERT_EQ(half.size(), cv::Size(5, 5));
  EXPECT_EQ(half(2, 2), 0);
  EXPECT_EQ(half(1, 1), 1000);  // the hole beside it has no weight
}

}  // namespace
}  // namespace saccade
