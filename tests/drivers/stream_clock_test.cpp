#include "drivers/openni2/stream_clock.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

using std::chrono::milliseconds;

class StreamClockTest : public ::testing::Test {
 protected:
  // The time of a frame that comes `machine_ms` after the test began.
  std::int64_t at(int machine_ms, std::int64_t device_us) {
    return clock_.time_us(device_us, start_ + milliseconds(machine_ms));
  }
  const StreamClock::Clock::time_point start_ = StreamClock::Clock::now();
  StreamClock clock_;
};

TEST_F(StreamClockTest, TheDeviceKnowsBestWhenAFrameWasTaken) {
  EXPECT_EQ(at(0, 777'000), 0);
  EXPECT_EQ(at(40, 810'333), 33'333) << "though it came late";
  EXPECT_EQ(at(67, 843'666), 66'666);
}

TEST_F(StreamClockTest, AfterALossTheMachinesClockGivesTheTimeAway) {
  at(0, 5'000'000);
  at(33, 5'033'333);
  clock_.restart();
  EXPECT_EQ(at(4'000, 100), 4'000'000) << "the device counts from 0 again";
  EXPECT_EQ(at(4'033, 33'433), 4'033'333);
}

TEST_F(StreamClockTest, AJumpOfTheDeviceIsNotFollowed) {
  for (const std::int64_t jump_us : {-3'600'000'000, 3'600'000'000}) {
    StreamClock clock;
    EXPECT_EQ(clock.time_us(4'000'000'000, start_), 0);
    EXPECT_EQ(clock.time_us(4'000'000'000 + jump_us, start_ + milliseconds(33)), 33'000);
    EXPECT_EQ(clock.time_us(4'000'033'333 + jump_us, start_ + milliseconds(70)), 66'333);
  }
}

TEST_F(StreamClockTest, ClocksThatDriftApartDoNotMatter) {
  std::int64_t last_us = -1;
  for (int k = 0; k < 400'000; ++k) {  // the device's clock runs a thousandth fast
    const std::int64_t time_us = at(33 * k, 33'033 * std::int64_t{k});
    ASSERT_EQ(time_us, 33'033 * std::int64_t{k});
    ASSERT_GT(time_us, last_us);
    last_us = time_us;
  }
}

TEST_F(StreamClockTest, TimesAlwaysGrow) {
  EXPECT_EQ(at(0, 1'000), 0);
  EXPECT_EQ(at(33, 34'333), 33'333);
  EXPECT_EQ(at(34, 34'333), 33'334) << "the same time twice";
  EXPECT_EQ(at(35, 20'000), 33'335) << "and one from before";
  EXPECT_EQ(at(67, 67'666), 66'666);
}

}  // namespace
}  // namespace saccade
