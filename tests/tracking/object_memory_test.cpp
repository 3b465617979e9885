#include "tracking/object_memory.hpp"

#include <set>

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

// A box before a wall, and its cells.
class ObjectMemoryTest : public ::testing::Test {
 protected:
  ObjectMemoryTest() { see(with_box()); }

  static cv::Mat1f wall() { return cv::Mat1f(120, 160, 2000.0F); }
  static cv::Mat1f with_box() {
    cv::Mat1f depth = wall();
    depth(kBox) = 1000.0F;
    return depth;
  }

  void see(const cv::Mat1f& depth_mm) { grid_.build(depth_mm, kCamera); }

  TrackedObject& add_box(std::int64_t time_us = 0) {
    TrackedObject& object = memory_.add();
    memory_.give_id(object);
    object.sight = Sight::visible;
    for (int r = kBox.y / 4; r < (kBox.y + kBox.height) / 4; ++r)
      for (int c = kBox.x / 4; c < (kBox.x + kBox.width) / 4; ++c)
        object.cells.push_back(r * grid_.cols() + c);
    object.anchor_mm = kCamera.point_mm(kBox.y + kBox.height / 2, kBox.x + kBox.width / 2, 1000);
    object.last_reported_us = time_us;
    memory_.learn(grid_, kStill);
    return object;
  }

  static inline const cv::Rect kBox{64, 40, 32, 40};
  ObjectMemory memory_{30};
  SurfaceGrid grid_;
  std::vector<int> owner_ = std::vector<int>(30 * 40, 0);
};

TEST_F(ObjectMemoryTest, LearnsTheSurface) {
  const TrackedObject& object = add_box();
  EXPECT_EQ(object.frames_seen, 1);
  EXPECT_GE(object.surface_mm.size(), 60U);
  EXPECT_NEAR(object.area_mm2, 32 * 40 * 25, 100) << "a pixel is 5 mm wide at 1 m";
  EXPECT_NEAR(object.centroid_mm.z, 1000, 1);
}

TEST_F(ObjectMemoryTest, SeesWhatIsThere) {
  TrackedObject& object = add_box();
  memory_.predict(grid_, kStill);
  EXPECT_EQ(object.sight, Sight::visible);
  EXPECT_EQ(object.anchor_sight, AnchorSight::visible);
  EXPECT_EQ(object.anchor_cell, 15 * 40 + 20);
}

TEST_F(ObjectMemoryTest, AnEmptyPlaceIsForgottenInTheSecondFrame) {
  TrackedObject& object = add_box();
  owner_[5] = memory_.owner_of(object);
  see(wall());
  memory_.predict(grid_, kStill);
  EXPECT_EQ(object.sight, Sight::empty);
  EXPECT_EQ(object.anchor_sight, AnchorSight::off);
  memory_.forget(0, owner_);
  EXPECT_TRUE(object.alive);
  memory_.predict(grid_, kStill);
  memory_.forget(0, owner_);
  EXPECT_FALSE(object.alive);
  EXPECT_EQ(owner_[5], 0);
}

TEST_F(ObjectMemoryTest, WhatIsHiddenIsRememberedForAWhile) {
  TrackedObject& object = add_box(10 * kSecond_us);
  cv::Mat1f hidden = with_box();
  hidden(cv::Rect(40, 20, 80, 80)) = 700.0F;
  see(hidden);
  memory_.predict(grid_, kStill);
  EXPECT_EQ(object.sight, Sight::hidden);
  EXPECT_EQ(object.anchor_sight, AnchorSight::hidden);
  memory_.forget(39 * kSecond_us, owner_);
  EXPECT_TRUE(object.alive);
  memory_.forget(41 * kSecond_us, owner_);
  EXPECT_FALSE(object.alive) << "30 s after it was reported";
}

TEST_F(ObjectMemoryTest, NoReadingAndOutOfViewAreHidden) {
  TrackedObject& object = add_box();
  see(cv::Mat1f(120, 160, 0.0F));
  memory_.predict(grid_, kStill);
  EXPECT_EQ(object.sight, Sight::hidden);
  see(wall());
  memory_.predict(grid_, cv::Affine3d(cv::Matx33d::eye(), cv::Vec3d(5000, 0, 0)));
  EXPECT_EQ(object.sight, Sight::hidden);
  EXPECT_EQ(object.anchor_sight, AnchorSight::out_of_view);
}

TEST_F(ObjectMemoryTest, CandidatesThatAreNotChosenGo) {
  TrackedObject& candidate = memory_.add();
  candidate.chosen = true;
  memory_.forget(0, owner_);
  EXPECT_TRUE(candidate.alive);
  candidate.chosen = false;
  memory_.forget(0, owner_);
  EXPECT_TRUE(candidate.alive) << "one frame may miss it";
  memory_.forget(0, owner_);
  EXPECT_FALSE(candidate.alive);
}

TEST_F(ObjectMemoryTest, IdsAreNeverUsedAgain) {
  std::set<int> ids;
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 3; ++k) {
      TrackedObject& object = memory_.add();
      memory_.give_id(object);
      EXPECT_TRUE(ids.insert(object.id).second);
    }
    memory_.clear();
  }
  EXPECT_EQ(memory_.slots().size(), 3U) << "slots are";
}

TEST_F(ObjectMemoryTest, ACorrectedWorldMovesWhatWasSeenLast) {
  TrackedObject& seen = add_box();
  const cv::Point3d before = seen.anchor_mm;
  TrackedObject hidden = seen;
  hidden.sight = Sight::hidden;
  memory_.slots().push_back(hidden);
  memory_.correct(cv::Affine3d(cv::Matx33d::eye(), cv::Vec3d(7, 0, 0)));
  EXPECT_EQ(memory_.slots()[0].anchor_mm, before + cv::Point3d(7, 0, 0));
  EXPECT_EQ(memory_.slots()[1].anchor_mm, before);
}

}  // namespace
}  // namespace saccade
