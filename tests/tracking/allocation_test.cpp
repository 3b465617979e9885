// Attention over time allocates no memory for a frame, once it knows the scene. Not counted: the odometry,
// which is OpenCV's and works on a thread of its own.
#include <gtest/gtest.h>

#include "tests/support/allocations.hpp"
#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"
#include "watched_scene.hpp"

namespace saccade {
namespace {

TEST(TrackingMemory, NothingIsAllocatedPerFrame) {
  cv::setNumThreads(1);
  WatchedScene scene({.noise = false});
  const Frame frame = scene.frame(0);
  const cv::Mat1f map = scene.saliency();
  FrameFollower follower;
  AttentionTracker tracker(20, 0, {});
  Attention attention;
  constexpr int kKnown = 90;  // frames after which everything in view was looked at once or is remembered
  std::int64_t allocated = 0;
  for (int k = 0; k < kKnown + 60; ++k) {
    Frame next = frame;
    next.index = k;
    next.timestamp_us = k * 100'000;
    follower.start(next);
    follower.wait();
    const std::int64_t before = allocations_of_this_thread();
    tracker.attend(next, map, follower.surfaces(), follower.step(), attention);
    if (k >= kKnown) allocated += allocations_of_this_thread() - before;
  }
  EXPECT_GT(attention.fixations.size(), 3U);
  EXPECT_EQ(allocated, 0);
}

}  // namespace
}  // namespace saccade
