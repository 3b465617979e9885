#include "app/progress.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(Progress, ShowsFramesRateAndTimeLeft) {
  EXPECT_EQ(progress_text(45, 90, 1.5), "45 of 90 frames, 30.0/s, 2 s left");
  EXPECT_EQ(progress_text(0, 90, 0), "0 of 90 frames, 0.0/s");
  EXPECT_EQ(progress_text(45, std::nullopt, 1.5), "45 frames, 30.0/s");
}

}  // namespace
}  // namespace saccade
