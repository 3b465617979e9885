#include "tracking/gaze.hpp"

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

using Targets = std::vector<Gaze::Target>;

// The gaze at a time in seconds.
int look(Gaze& gaze, double time_s, const Targets& targets) {
  return gaze.look(static_cast<std::int64_t>(time_s * kSecond_us), targets).value_or(0);
}

TEST(Gaze, DwellsThenTakesTheNextInOrder) {
  Gaze gaze({.dwell_s = 0.5, .return_after_s = 5});
  const Targets targets = {{7, 1, false}, {3, 0.9F, false}, {5, 0.8F, false}};
  EXPECT_EQ(look(gaze, 0, targets), 7);
  EXPECT_EQ(look(gaze, 0.49, targets), 7);
  EXPECT_EQ(look(gaze, 0.5, targets), 3);
  EXPECT_EQ(look(gaze, 1.0, targets), 5);
}

TEST(Gaze, StaysWhereAllWereLookedAtAndReturnsLater) {
  Gaze gaze({.dwell_s = 0.5, .return_after_s = 2});
  const Targets targets = {{1, 1, false}, {2, 0.9F, false}};
  EXPECT_EQ(look(gaze, 0, targets), 1);
  EXPECT_EQ(look(gaze, 0.5, targets), 2);
  EXPECT_EQ(look(gaze, 2.4, targets), 2) << "1 was looked at until 0.5 s";
  EXPECT_EQ(look(gaze, 2.6, targets), 1);
  EXPECT_EQ(look(gaze, 3.2, targets), 1) << "2 was looked at until 2.6 s";
  EXPECT_EQ(look(gaze, 4.6, targets), 2);
}

TEST(Gaze, MovesOnAtOnceWhenTheObjectIsGone) {
  Gaze gaze({.dwell_s = 10, .return_after_s = 100});
  EXPECT_EQ(look(gaze, 0, {{1, 1, false}, {2, 0.9F, false}}), 1);
  EXPECT_EQ(look(gaze, 0.1, {{2, 0.9F, false}}), 2);
  EXPECT_EQ(look(gaze, 0.2, {}), 0);
  EXPECT_EQ(look(gaze, 0.3, {{2, 0.9F, false}, {1, 0.5F, false}}), 1)
      << "of those looked at, the longest ago";
}

TEST(Gaze, AStrongNewObjectInterruptsAWeakOneComesNext) {
  Gaze gaze({.dwell_s = 0.5, .return_after_s = 5});
  const Targets before = {{1, 1, false}, {2, 0.9F, false}};
  EXPECT_EQ(look(gaze, 0, before), 1);
  EXPECT_EQ(look(gaze, 0.1, {{9, 2.1F, true}, {1, 1, false}, {2, 0.9F, false}}), 9);
  EXPECT_EQ(look(gaze, 0.2, {{9, 2.1F, true}, {1, 1, false}, {2, 0.9F, false}, {8, 0.1F, true}}), 9);
  EXPECT_EQ(look(gaze, 0.6, {{9, 2.1F, true}, {1, 1, false}, {2, 0.9F, false}, {8, 0.1F, true}}), 8)
      << "before the stronger 2, which has been there for long";
  EXPECT_EQ(look(gaze, 1.1, {{9, 2.1F, true}, {1, 1, false}, {2, 0.9F, false}, {8, 0.1F, true}}), 2);
}

TEST(Gaze, ANewObjectThatIsALittleStrongerWaitsForTheEndOfTheDwell) {
  Gaze gaze({.dwell_s = 0.5, .return_after_s = 5});
  EXPECT_EQ(look(gaze, 0, {{1, 1, false}}), 1);
  EXPECT_EQ(look(gaze, 0.1, {{9, 1.9F, true}, {1, 1, false}}), 1);
  EXPECT_EQ(look(gaze, 0.5, {{9, 1.9F, true}, {1, 1, false}}), 9);
}

TEST(Gaze, TimesCountNotCalls) {
  const Targets targets = {{1, 1, false}, {2, 0.9F, false}, {3, 0.8F, false}};
  Gaze every({}), some({});
  for (int i = 0; i <= 60; ++i) {
    const int seen = look(every, i / 30.0, targets);
    if (i % 15 != 0) continue;
    EXPECT_EQ(look(some, i / 30.0, targets), seen) << i;
  }
}

TEST(Gaze, ClearForgetsWhatWasLookedAt) {
  Gaze gaze({.dwell_s = 0.5, .return_after_s = 100});
  const Targets targets = {{1, 1, false}, {2, 0.9F, false}};
  EXPECT_EQ(look(gaze, 0, targets), 1);
  EXPECT_EQ(look(gaze, 1, targets), 2);
  gaze.clear();
  EXPECT_EQ(look(gaze, 2, targets), 1);
}

}  // namespace
}  // namespace saccade
