#include "ui/session/stage_history.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace saccade {
namespace {

using namespace std::chrono_literals;

StageTimes times_of(double symmetry_ms, double attention_ms) {
  StageTimes times;
  times[Stage::symmetry] = symmetry_ms;
  times[Stage::attention] = attention_ms;
  return times;
}

TEST(StageHistory, LastMedianAndPercentileOfEachStage) {
  StageHistory history(100);
  for (int i = 1; i <= 100; ++i) history.add(times_of(101 - i, 2), 3 * i, StageHistory::Clock::time_point{});
  EXPECT_EQ(history.stage(Stage::symmetry).last_ms, 1);
  EXPECT_EQ(history.stage(Stage::symmetry).p50_ms, 50);
  EXPECT_EQ(history.stage(Stage::symmetry).p95_ms, 95);
  EXPECT_EQ(history.total().p50_ms, 52);
  EXPECT_EQ(history.latency().last_ms, 300);
  EXPECT_EQ(history.latency().p95_ms, 285);
}

TEST(StageHistory, ForgetsTheOldest) {
  StageHistory history(2);
  EXPECT_EQ(history.total().last_ms, 0);
  for (const double ms : {100.0, 1.0, 2.0}) history.add(times_of(ms, 0), 0, {});
  EXPECT_EQ(history.size(), 2U);
  EXPECT_EQ(history.stage(Stage::symmetry).p95_ms, 2);
  history.clear();
  EXPECT_EQ(history.latency().p50_ms, 0);
  EXPECT_THROW(StageHistory(0), std::invalid_argument);
}

TEST(StageHistory, RateIsThatOfTheLastTwoSeconds) {
  StageHistory history;
  const StageHistory::Clock::time_point begin{};
  for (int i = 0; i < 10; ++i) history.add({}, 0, begin + i * 1s);          // slow at first
  for (int i = 1; i <= 80; ++i) history.add({}, 0, begin + 9s + i * 50ms);  // then 20 a second
  EXPECT_NEAR(history.rate_hz(begin + 13s), 20, 1e-9);
  EXPECT_EQ(history.rate_hz(begin + 20s), 0) << "nothing comes any more";
}

TEST(StageHistory, StacksAddUp) {
  StageHistory history;
  history.add(times_of(3, 4), 0, {});
  const auto stacks = history.stacks();
  ASSERT_EQ(stacks.size(), 1U);
  EXPECT_EQ(stacks[0], (StageHistory::Stack{0, 0, 3, 3, 7}));
}

}  // namespace
}  // namespace saccade
