// Attention over time allocates no memory for a frame, once it knows the scene. Every call of operator new on
// this thread is counted, including those of images, since cv::Mat allocates the header of its pixels by it.
// Not counted: the odometry, which is OpenCV's and works on a thread of its own.
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"
#include "watched_scene.hpp"

namespace {
thread_local bool counting = false;
thread_local int allocations = 0;
}  // namespace

// Not inlined, since GCC would warn of free().
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

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
  for (int k = 0; k < kKnown + 60; ++k) {
    Frame next = frame;
    next.index = k;
    next.timestamp_us = k * 100'000;
    follower.start(next);
    follower.wait();
    counting = k >= kKnown;
    tracker.attend(next, map, follower.surfaces(), follower.step(), attention);
    counting = false;
  }
  EXPECT_GT(attention.fixations.size(), 3U);
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace saccade
