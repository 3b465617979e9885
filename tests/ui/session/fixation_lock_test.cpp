#include "ui/session/fixation_lock.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

Fixation at(float x, float y, float z, int col = 0) {
  Fixation fixation;
  fixation.position_mm = {x, y, z};
  fixation.col = col;
  return fixation;
}

TEST(FixationLock, FollowsTheNearestFromFrameToFrame) {
  FixationLock lock;
  EXPECT_EQ(lock.find({at(0, 0, 1000)}), -1) << "nothing is locked";
  lock.lock(at(0, 0, 1000));
  EXPECT_EQ(lock.find({at(90, 0, 1000), at(40, 0, 1000)}), 1);
  EXPECT_EQ(lock.find({at(120, 0, 1000), at(0, 0, 1000)}), 1) << "40 mm away, not 80";
  EXPECT_EQ(lock.find({at(500, 0, 1000)}), -1) << "another place";
  EXPECT_EQ(lock.find({at(500, 0, 1000), at(50, 0, 1000)}), 1) << "it is back";
  lock.unlock();
  EXPECT_EQ(lock.find({at(0, 0, 1000)}), -1);
}

TEST(FixationLock, OverTimeTheIdCounts) {
  FixationLock lock;
  Fixation first = at(0, 0, 1000), moved = at(900, 0, 1000), other = at(10, 0, 1000);
  first.id = moved.id = 3;
  other.id = 4;
  lock.lock(first);
  EXPECT_EQ(lock.find({other, moved}), 1);
  EXPECT_EQ(lock.find({other}), -1);
}

TEST(FixationLock, AnIdThatIsYoungerThanItWasMayBeAnotherObject) {
  FixationLock lock;
  Fixation old = at(0, 0, 1000), elsewhere = at(900, 0, 1000), same_place = at(10, 0, 1000);
  old.id = elsewhere.id = same_place.id = 3;
  old.age_frames = 50;
  elsewhere.age_frames = same_place.age_frames = 1;
  lock.lock(old);
  EXPECT_EQ(lock.find({elsewhere}), -1);
  EXPECT_EQ(lock.find({same_place}), 0);
}

TEST(FixationLock, WithoutDepthThePixelsCount) {
  FixationLock lock;
  lock.lock(at(0, 0, 0, 100));
  EXPECT_EQ(lock.find({at(0, 0, 0, 140), at(0, 0, 0, 110)}), 1);
  EXPECT_EQ(lock.find({at(0, 0, 0, 140)}), -1);
}

}  // namespace
}  // namespace saccade
