#include "ui/session/rate_meter.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

using namespace std::chrono_literals;

TEST(RateMeter, CountsTheLastTwoSeconds) {
  RateMeter meter;
  EXPECT_EQ(meter.rate_hz(), 0);
  RateMeter::Time now{100s};
  std::int64_t total = 0;
  for (int i = 0; i < 40; ++i, now += 100ms) meter.count(total += 3, now);
  EXPECT_NEAR(meter.rate_hz(), 30, 0.1);
  for (int i = 0; i < 40; ++i, now += 100ms) meter.count(total, now);
  EXPECT_EQ(meter.rate_hz(), 0) << "nothing comes any more";
}

TEST(RateMeter, AnotherSourceRestartsIt) {
  RateMeter meter;
  const RateMeter::Time now{100s};
  meter.count(500, now);
  meter.count(0, now + 1s);
  meter.count(10, now + 2s);
  EXPECT_EQ(meter.rate_hz(), 10);
}

}  // namespace
}  // namespace saccade
