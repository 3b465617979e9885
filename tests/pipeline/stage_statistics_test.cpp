#include "pipeline/stage_statistics.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(DurationHistogram, PercentilesAreGoodToOnePercent) {
  DurationHistogram times;
  for (int i = 1; i <= 1000; ++i) times.add(i * 0.1);
  EXPECT_EQ(times.count(), 1000);
  EXPECT_NEAR(times.mean_ms(), 50.05, 1e-9);
  EXPECT_NEAR(times.percentile_ms(0.50), 50, 0.6);
  EXPECT_NEAR(times.percentile_ms(0.95), 95, 1.1);
  EXPECT_EQ(times.max_ms(), 100);
  EXPECT_LE(times.percentile_ms(1.0), times.max_ms());
}

TEST(DurationHistogram, EmptyZeroAndHugeAreInRange) {
  DurationHistogram times;
  EXPECT_EQ(times.percentile_ms(0.5), 0);
  times.add(0);
  times.add(1e12);
  EXPECT_EQ(times.count(), 2);
  EXPECT_EQ(times.max_ms(), 1e12);
  EXPECT_LT(times.percentile_ms(0.1), 0.01);
}

}  // namespace
}  // namespace saccade
