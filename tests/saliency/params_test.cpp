#include "saliency/params.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace saccade {
namespace {

TEST(Levels, EachIsHalfOfTheOneBeforeAndTheDeepestHasEightPixels) {
  EXPECT_EQ(level_size({640, 480}, 3), cv::Size(80, 60));
  EXPECT_EQ(level_size({7, 5}, 1), cv::Size(4, 3)) << "the even rows and columns, the last one too";
  EXPECT_EQ(deepest_level({640, 480}), 6) << "10x8";
  EXPECT_EQ(deepest_level({64, 48}), 2);
  EXPECT_EQ(deepest_level({8, 8}), 0);
  EXPECT_EQ(deepest_level({640, 7}), -1);
}

TEST(Levels, ChosenOnesThatDoNotFitAreRefused) {
  EXPECT_NO_THROW(check_levels({64, 48}, {.last_level = 2}));
  EXPECT_THROW(check_levels({64, 48}, {.last_level = 3}), Error);
  EXPECT_THROW(check_levels({4, 4}, {.last_level = 0}), Error);
}

}  // namespace
}  // namespace saccade
