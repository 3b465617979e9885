// The marks of a sequence: calm, but not lagging.
#include "ui/session/sequence_marks.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

class SequenceMarksTest : public ::testing::Test {
 protected:
  SequenceMarksTest() {
    frame_.depth_mm.create(240, 320);
    frame_.intrinsics = {300, 300, 160, 120, IntrinsicsOrigin::file};
  }

  // A fixation at a place in the world, mm.
  static Fixation object(int id, cv::Point3f world_mm) {
    Fixation fixation;
    fixation.id = id;
    fixation.world_mm = world_mm;
    return fixation;
  }

  // A frame `seconds` after the start; the camera is at `camera_mm`.
  SequenceMarks see(double seconds, const std::vector<Fixation>& fixations, std::optional<int> gaze,
                    cv::Vec3d camera_mm = {}, bool cut = false, float largest = 1, bool other_map = false) {
    frame_.timestamp_us = static_cast<std::int64_t>(seconds * 1e6);
    Attention attention;
    attention.fixations = fixations;
    attention.sequence = SequenceState{gaze, cut, cv::Affine3d(cv::Matx33d::eye(), camera_mm)};
    return history_.next(frame_, attention, largest, other_map, 5);
  }

  Frame frame_;
  MarkHistory history_;
};

TEST_F(SequenceMarksTest, NoiseIsSmoothedAndTheCameraIsFollowedAtOnce) {
  EXPECT_EQ(see(0, {object(1, {0, 0, 1000})}, {}).marks.at(0).place, cv::Point2d(160.5, 120.5));
  const double shaken = see(0.033, {object(1, {10, 0, 1000})}, {}).marks.at(0).place.x;
  EXPECT_GT(shaken, 160.5);
  EXPECT_LT(shaken, 161) << "3 px without smoothing";
  MarkHistory still = history_;
  const double before = see(0.066, {object(1, {0, 0, 1000})}, {}).marks.at(0).place.x;
  history_ = still;
  const double after = see(0.066, {object(1, {0, 0, 1000})}, {}, {100, 0, 0}).marks.at(0).place.x;
  EXPECT_NEAR(before - after, 30, 1e-9);
}

TEST_F(SequenceMarksTest, AnObjectThatHasMovedIsFollowedAtOnce) {
  see(0, {object(1, {0, 0, 1000})}, {});
  EXPECT_NEAR(see(0.033, {object(1, {200, 0, 1000})}, {}).marks.at(0).place.x, 220.5, 1e-9);
}

TEST_F(SequenceMarksTest, WhatWasLookedAtIsAttendedUntilTheGazeMayReturn) {
  const std::vector<Fixation> both = {object(1, {0, 0, 1000}), object(2, {100, 0, 1000})};
  EXPECT_FALSE(see(0, both, 1).marks.at(0).attended) << "it is looked at now";
  const SequenceMarks later = see(0.5, both, 2);
  EXPECT_TRUE(later.marks.at(0).attended);
  EXPECT_FALSE(later.marks.at(1).attended);
  ASSERT_EQ(later.trail.size(), 2U);
  EXPECT_EQ(later.trail.back(), later.marks.at(1).place);
  EXPECT_FALSE(see(5.1, both, 2).marks.at(0).attended);
  const SequenceMarks back = see(5.2, both, 1);
  EXPECT_EQ(back.marks.at(0).looks, 2);
  EXPECT_EQ(back.marks.at(1).looks, 1);
  EXPECT_NEAR(back.marks.at(0).age_s, 5.2, 1e-6);
}

TEST_F(SequenceMarksTest, TheRangeOfColoursFollowsSlowly) {
  EXPECT_EQ(see(0, {}, {}, {}, false, 2).range_high, 2);
  const float next = see(0.033, {}, {}, {}, false, 4).range_high;
  EXPECT_GT(next, 2);
  EXPECT_LT(next, 2.05F);
  for (double t = 0.066; t < 20; t += 0.033) see(t, {}, {}, {}, false, 4);
  EXPECT_NEAR(see(20, {}, {}, {}, false, 4).range_high, 4, 0.01);
  EXPECT_EQ(see(20.1, {}, {}, {}, false, 100, true).range_high, 100) << "of another model";
}

TEST_F(SequenceMarksTest, ACutBeginsAgain) {
  see(0, {object(1, {0, 0, 1000})}, 1, {}, false, 2);
  const SequenceMarks cut = see(0.033, {object(2, {0, 0, 1000})}, 2, {}, true, 8);
  EXPECT_EQ(cut.trail.size(), 1U);
  EXPECT_EQ(cut.range_high, 8);
  EXPECT_EQ(cut.marks.at(0).age_s, 0);
}

}  // namespace
}  // namespace saccade
