#include "tracking/camera_motion.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "watched_scene.hpp"

namespace saccade {
namespace {

class CameraMotionTest : public ::testing::Test {
 protected:
  CameraMotionTest() { cv::setNumThreads(1); }

  CameraStep follow(const Frame& frame) { return follow(frame, frame.colour); }
  CameraStep follow(const Frame& frame, const cv::Mat3b& colour) {
    grid_.build(frame.depth_mm, frame.intrinsics);
    return motion_.follow(grid_, colour);
  }

  CameraStep follow_after_gap(const Frame& frame) {
    grid_.build(frame.depth_mm, frame.intrinsics);
    return motion_.follow(grid_, frame.colour, true);
  }

  // How far a point 1 m before the camera is from where it is by the truth, mm.
  static double error_mm(const cv::Affine3d& pose, const cv::Affine3d& truth) {
    return cv::norm(pose * cv::Point3d(0, 0, 1000) - truth * cv::Point3d(0, 0, 1000));
  }

  SurfaceGrid grid_;
  CameraMotion motion_;
};

TEST_F(CameraMotionTest, FollowsACameraThatIsHeldInAHand) {
  for (const char* scene : {"table", "room"}) {
    motion_.restart();
    WatchedScene watched({.scene = scene, .camera = scene::CameraPath::walk});
    cv::Affine3d first, last;
    double step_error = 0;
    for (int k = 0; k < 30; ++k) {
      const Frame& frame = watched.frame(k);
      const cv::Affine3d truth = *frame.truth.camera_to_world;
      const CameraStep step = follow(frame);
      if (k == 0)
        first = truth;
      else {
        EXPECT_FALSE(step.cut) << scene << k;
        step_error = std::max(step_error, error_mm(step.to_previous, inverse(last) * truth));
        EXPECT_LT(error_mm(step.to_world, inverse(first) * truth), 20) << scene << k;
      }
      last = truth;
    }
    EXPECT_LT(step_error, 8) << scene;
  }
}

TEST_F(CameraMotionTest, DepthAloneWillDo) {
  WatchedScene watched({.scene = "room", .camera = scene::CameraPath::orbit});
  const cv::Affine3d first = *watched.frame(0).truth.camera_to_world;
  for (int k = 0; k < 20; ++k) {
    const Frame& frame = watched.frame(k);
    const CameraStep step = follow(frame, {});
    EXPECT_FALSE(step.cut);
    EXPECT_LT(error_mm(step.to_world, inverse(first) * *frame.truth.camera_to_world), 20) << k;
  }
}

TEST_F(CameraMotionTest, TheFirstFrameIsNoCutAnotherSceneIs) {
  WatchedScene table({.scene = "table"}), room({.scene = "room"});
  EXPECT_FALSE(follow(table.frame(0)).cut);
  EXPECT_FALSE(follow(table.frame(1)).cut);
  const CameraStep step = follow(room.frame(2));
  EXPECT_TRUE(step.cut);
  EXPECT_EQ(step.to_world.matrix, cv::Affine3d::Identity().matrix) << "the world begins again";
  EXPECT_FALSE(follow(room.frame(3)).cut);
}

// Other tables share table, floor and wall with this one: more than 80 % of the cells are where they were.
TEST_F(CameraMotionTest, AfterAGapAnotherTableIsACutTheSameIsNot) {
  for (const std::uint64_t other : {4U, 5U, 6U}) {
    motion_.restart();
    WatchedScene table({.scene = "table", .camera = scene::CameraPath::orbit});
    follow(table.frame(0));
    EXPECT_FALSE(follow_after_gap(table.frame(30)).cut) << "from another place";
    WatchedScene another({.scene = "table", .seed = other, .camera = scene::CameraPath::orbit});
    EXPECT_TRUE(follow_after_gap(another.frame(30)).cut) << other;
    EXPECT_FALSE(follow(another.frame(31)).cut);
  }
}

TEST_F(CameraMotionTest, AfterAGapOneObjectMoreOrLessIsNoCut) {
  for (const scene::EventKind event : {scene::EventKind::add, scene::EventKind::take}) {
    motion_.restart();
    WatchedScene table({.scene = "table", .event = event});
    follow(table.frame(0));
    EXPECT_FALSE(follow_after_gap(table.frame(120)).cut);
  }
}

TEST_F(CameraMotionTest, AnotherCameraOrARestartIsACut) {
  WatchedScene table({.scene = "table"}), small({.scene = "table", .size = {160, 120}});
  EXPECT_FALSE(follow(table.frame(0)).cut);
  EXPECT_TRUE(follow(small.frame(1)).cut);
  EXPECT_FALSE(follow(small.frame(2)).cut);
  motion_.restart();
  EXPECT_TRUE(follow(small.frame(3)).cut);
}

TEST_F(CameraMotionTest, FramesWithoutReadingsAreWaitedFor) {
  WatchedScene watched({.camera = scene::CameraPath::walk});
  Frame blank;
  copy_frame(watched.frame(0), blank);
  blank.depth_mm.setTo(0);
  EXPECT_FALSE(follow(blank).cut);
  cv::Affine3d first;
  for (int k = 0; k < 12; ++k) {
    const Frame& frame = watched.frame(k);
    if (k == 0) first = *frame.truth.camera_to_world;
    const CameraStep step = follow(k == 5 || k == 6 ? blank : frame);
    EXPECT_FALSE(step.cut) << k;
    if (k <= 6) continue;
    EXPECT_LT(error_mm(step.to_world, inverse(first) * *frame.truth.camera_to_world), 20) << k;
  }
}

// The camera turns away by 80 degrees and back: known views are seen again, so that drift is taken back.
TEST_F(CameraMotionTest, ComesBackToWhereItWas) {
  WatchedScene room({.scene = "room", .camera = scene::CameraPath::pan});
  const cv::Affine3d first = *room.frame(0).truth.camera_to_world;
  CameraStep step;
  bool corrected = false;
  for (int k = 0; k <= 240; k += 2) {
    step = follow(room.frame(k));
    ASSERT_FALSE(step.cut) << k;
    corrected = corrected || cv::norm(step.world_correction.translation()) > 0;
  }
  EXPECT_TRUE(corrected);
  EXPECT_LT(error_mm(step.to_world, inverse(first) * *room.frame(240).truth.camera_to_world), 10);
}

TEST_F(CameraMotionTest, TheSameFramesGiveTheSameBits) {
  WatchedScene watched({.camera = scene::CameraPath::walk});
  CameraMotion other;
  SurfaceGrid grid;
  for (int k = 0; k < 8; ++k) {
    const Frame& frame = watched.frame(k);
    const CameraStep step = follow(frame);
    grid.build(frame.depth_mm, frame.intrinsics);
    EXPECT_EQ(other.follow(grid, frame.colour).to_world.matrix, step.to_world.matrix) << k;
  }
}

}  // namespace
}  // namespace saccade
