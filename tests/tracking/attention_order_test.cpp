#include "tracking/attention_order.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "followed_frames.hpp"
#include "tracking/attention_tracker.hpp"
#include "tracking/frame_follower.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

// Two blocks before a wall, one of them always the more salient. The camera moves to the right, so that the
// other one leaves the view.
class TwoBlocks {
 public:
  explicit TwoBlocks(double min_confidence = 0) : tracker_(10, min_confidence, {}) {
    cv::setNumThreads(1);
    frame_.intrinsics = {200, 200, 159.5, 119.5, IntrinsicsOrigin::sensor};
  }

  // The less salient block's fixation; none if it is not reported. moved: px of the blocks. saliency: of it,
  // relative to the other one.
  std::optional<Fixation> see(int moved, float saliency) {
    const cv::Rect image(0, 0, 320, 240);
    const cv::Rect weak = cv::Rect(40 - moved, 80, 80, 80) & image, strong(200 - moved, 80, 80, 80);
    frame_.depth_mm = cv::Mat1f(image.size(), 3000.0F);
    frame_.depth_mm(weak) = 1000;
    frame_.depth_mm(strong) = 1000;
    cv::Mat1f map(image.size(), 0.0F);
    map(weak) = saliency;
    map(strong) = 1;
    follower_.start(frame_);
    follower_.wait();
    CameraStep step;
    step.cut = frame_.index == 0;
    step.to_world = cv::Affine3d().translate({5.0 * moved, 0, 0});  // 5 mm a pixel at 1 m
    step.to_previous = cv::Affine3d().translate({5.0 * (moved - moved_), 0, 0});
    moved_ = moved;
    Attention attention;
    tracker_.attend(frame_, map, follower_.surfaces(), step, attention);
    ++frame_.index;
    frame_.timestamp_us += 100'000;
    for (const Fixation& fixation : attention.fixations)
      if (fixation.col < strong.x && weak.contains({fixation.col, fixation.row})) return fixation;
    return std::nullopt;
  }

 private:
  Frame frame_;
  FrameFollower follower_;
  AttentionTracker tracker_;
  int moved_ = 0;
};

TEST(AttentionOrder, WhatLeavesTheViewIsNotDoubted) {
  TwoBlocks blocks(0);
  const auto whole = blocks.see(0, 0.01F);
  ASSERT_TRUE(whole);
  for (int k = 1; k <= 60; ++k) {
    const int moved = std::min(4 * k, 104);
    const auto cut = blocks.see(moved, 0.01F);
    ASSERT_TRUE(cut) << moved;
    EXPECT_GE(*cut->confidence, *whole->confidence - 0.001F) << moved;
  }
}

TEST(AttentionOrder, WhatWasReportedStaysUntilItIsWellBelowTheThreshold) {
  const float before = *TwoBlocks(0).see(0, 1)->confidence, after = *TwoBlocks(0).see(0, 0.01F)->confidence;
  ASSERT_GT(before - after, 0.107);
  const double stays = after + 0.09, goes = after + 0.105;
  for (const double threshold : {stays, goes}) {
    TwoBlocks sure(threshold);
    for (int k = 0; k < 30; ++k) ASSERT_TRUE(sure.see(0, 1));
    std::optional<Fixation> last;
    for (int k = 0; k < 120; ++k) {
      last = sure.see(0, 0.01F);
      EXPECT_TRUE(last || k > 20) << "what it was for seconds counts";
      if (last) {
        EXPECT_GE(*last->confidence, static_cast<float>(threshold));
      }
    }
    EXPECT_EQ(last.has_value(), threshold == stays) << threshold;
  }
}

// At 80 pixels half of the block is still in view, and another point stands in for the one that is not.
TEST(AttentionOrder, AnAnchorThatWasOutOfViewForAMomentIsWhereItWas) {
  for (const int frames_away : {2, 10}) {
    TwoBlocks blocks;
    std::optional<Fixation> before, away, back;
    for (int k = 0; k < 5; ++k) before = blocks.see(0, 0.5F);
    for (int k = 0; k < frames_away; ++k) away = blocks.see(80, 0.5F);
    for (int k = 0; k < 2; ++k) back = blocks.see(0, 0.5F);
    ASSERT_TRUE(before && away && back);
    EXPECT_EQ(back->id, before->id);
    EXPECT_GT(cv::norm(away->world_mm - before->world_mm), 50);
    EXPECT_LT(cv::norm(back->world_mm - (frames_away == 2 ? before : away)->world_mm), 10) << frames_away;
  }
}

// In every third frame the block has another row of cells above the most salient one. That takes back the
// time of one frame at the border, and not all of it.
TEST(AttentionOrder, AnAnchorLeavesABorderThatNoiseMoves) {
  for (const bool noisy : {false, true}) {
    Frame frame;
    frame.intrinsics = Intrinsics::guess_for({320, 240});
    FollowedFrames frames(1);
    std::vector<int> rows;
    for (int k = 0; k < 60; ++k) {
      frame.depth_mm = cv::Mat1f(240, 320, 3000.0F);
      frame.depth_mm(cv::Rect(120, 80, 80, 80)) = 1000;
      if (noisy && k % 3 == 2) frame.depth_mm(cv::Rect(120, 76, 80, 4)) = 1000;
      cv::Mat1f map(frame.size(), 0.0F);
      map(cv::Rect(156, 80, 8, 4)) = 1;
      const Attention& attention = frames.attend(frame, map);
      ASSERT_EQ(attention.fixations.size(), 1) << k;
      rows.push_back(attention.fixations[0].row);
    }
    const auto inside = std::find_if(rows.begin(), rows.end(), [](int row) { return row >= 84; });
    EXPECT_GT(inside - rows.begin(), 15) << noisy;
    EXPECT_LT(inside - rows.begin(), noisy ? 50 : 20) << noisy;
    EXPECT_TRUE(std::all_of(inside, rows.end(), [](int row) { return row >= 84; })) << noisy;
  }
}

// Blocks before a wall and three fixations; how salient each block is, is given.
class FullOrder {
 public:
  FullOrder() {
    frame_.depth_mm = cv::Mat1f(240, 320, 3000.0F);
    for (int k = 0; k < 4; ++k) set_depth(k, 1500);
    frame_.intrinsics = Intrinsics::guess_for(frame_.size());
  }

  static cv::Rect place(int k) { return {20 + 76 * k, 100, 40, 40}; }
  void set_depth(int k, float depth_mm) { frame_.depth_mm(place(k)) = depth_mm; }

  // The places that are fixated after some frames at 30 Hz with this saliency, first in order first.
  std::vector<int> watch(const std::vector<float>& saliency, int frames) {
    cv::Mat1f map(240, 320, 0.0F);
    for (int k = 0; k < 4; ++k) map(place(k)) = saliency[static_cast<std::size_t>(k)];
    for (int i = 1; i < frames; ++i) frames_.attend(frame_, map);
    std::vector<int> fixated;
    for (const Fixation& fixation : frames_.attend(frame_, map).fixations)
      for (int k = 0; k < 4; ++k)
        if (place(k).contains({fixation.col, fixation.row})) fixated.push_back(k);
    return fixated;
  }

 private:
  Frame frame_;
  FollowedFrames frames_{3};
};

TEST(AttentionOrder, WhatIsReportedStaysUnlessANewcomerIsMuchStronger) {
  FullOrder order;
  EXPECT_THAT(order.watch({1, 0.9F, 0.5F, 0}, 5), ElementsAre(0, 1, 2));
  EXPECT_THAT(order.watch({1, 0.9F, 0.5F, 4}, 120), UnorderedElementsAre(0, 1, 2)) << "8 times the weakest";
  EXPECT_THAT(order.watch({1, 0.9F, 0.5F, 9}, 120), UnorderedElementsAre(0, 1, 3))
      << "18 times; the weakest goes";
}

TEST(AttentionOrder, RanksChangeByAMarginOnly) {
  FullOrder order;
  EXPECT_THAT(order.watch({1, 0.9F, 0.8F, 0}, 5), ElementsAre(0, 1, 2));
  EXPECT_THAT(order.watch({0.35F, 0.9F, 0.8F, 0}, 60), ElementsAre(0, 1, 2)) << "2.6 times";
  EXPECT_THAT(order.watch({0.2F, 0.9F, 0.8F, 0}, 60), ElementsAre(1, 2, 0)) << "4.5 times";
}

TEST(AttentionOrder, WhatWasAwayForLongTakesNoPlaceThatIsFilled) {
  for (const int frames_away : {10, 40}) {
    FullOrder order;
    EXPECT_THAT(order.watch({1, 0.9F, 0.8F, 0.3F}, 5), ElementsAre(0, 1, 2));
    order.set_depth(1, 0);
    EXPECT_THAT(order.watch({1, 0.9F, 0.8F, 0.3F}, frames_away), ElementsAre(0, 2, 3));
    order.set_depth(1, 1500);
    const std::vector<int> after = order.watch({1, 0.9F, 0.8F, 0.3F}, 30);
    EXPECT_THAT(after, UnorderedElementsAre(0, 2, frames_away == 10 ? 1 : 3)) << frames_away;
  }
}

// A hill on the table top, `gap` pixels beside a block that stands on it.
int fixations_beside_a_block(int gap, int frames) {
  const cv::Rect block(120, 100, 40, 40);
  Frame frame;
  frame.depth_mm = cv::Mat1f(240, 320, 1000.0F);
  frame.depth_mm(block) = 900;
  frame.intrinsics = Intrinsics::guess_for(frame.size());
  cv::Mat1f map(240, 320, 0.0F);
  map(block) = 1;
  map(cv::Rect(block.br().x + gap, 116, 8, 8)) = 0.5F;
  FollowedFrames followed;
  for (int k = 1; k < frames; ++k) followed.attend(frame, map);
  int beside = 0;
  for (const Fixation& fixation : followed.attend(frame, map).fixations)
    beside +=
        fixation.row > 100 && fixation.row < 140 && fixation.col >= block.br().x + 4 && fixation.col < 260;
  return beside;
}

TEST(AttentionOrder, WhatASupportingPlaneHasNextToAnObjectIsThatObjects) {
  EXPECT_EQ(fixations_beside_a_block(40, 5), 1) << "far from it";
  EXPECT_EQ(fixations_beside_a_block(0, 1), 1) << "a single frame";
  EXPECT_EQ(fixations_beside_a_block(0, 5), 0);
}

}  // namespace
}  // namespace saccade
