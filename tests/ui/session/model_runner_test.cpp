// The computation of the viewer's results: reused parts, drafts and interrupted computations give the same
// results as a single computation.
#include "ui/session/model_runner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/other_value.hpp"
#include "ui/session/interactive_processor.hpp"

namespace saccade {
namespace {

Frame ball_frame(cv::Size size, std::int64_t index = 0) {
  Frame frame;
  frame.index = index;
  frame.intrinsics = Intrinsics::guess_for(size);
  frame.depth_mm.create(size);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c)
      frame.depth_mm(r, c) = 1000 - static_cast<float>(std::max(
                                        0.0, 200 - std::hypot(r - size.height / 2, c - size.width / 3) * 9));
  return frame;
}

Settings with_kernel(int kernel) {
  Settings settings;
  settings.kernel = kernel;
  settings.workers = 2;
  return settings;
}

bool same(const cv::Mat& x, const cv::Mat& y) {
  return x.size() == y.size() && x.type() == y.type() && (x.empty() || cv::norm(x, y, cv::NORM_INF) == 0);
}

void expect_same(const Computed& x, const Computed& y) {
  EXPECT_EQ(x.error, y.error);
  EXPECT_TRUE(same(x.result.maps.master, y.result.maps.master));
  EXPECT_TRUE(same(x.result.maps.normals, y.result.maps.normals));
  ASSERT_EQ(x.result.maps.levels.size(), y.result.maps.levels.size());
  for (std::size_t i = 0; i < x.result.maps.levels.size(); ++i)
    EXPECT_TRUE(same(x.result.maps.levels[i], y.result.maps.levels[i]));
  EXPECT_TRUE(same(x.smooth, y.smooth));
  EXPECT_TRUE(same(x.result.attention.masks, y.result.attention.masks));
  ASSERT_EQ(x.result.attention.fixations.size(), y.result.attention.fixations.size());
  for (std::size_t i = 0; i < x.result.attention.fixations.size(); ++i) {
    EXPECT_EQ(x.result.attention.fixations[i].row, y.result.attention.fixations[i].row);
    EXPECT_EQ(x.result.attention.fixations[i].col, y.result.attention.fixations[i].col);
  }
  EXPECT_EQ(x.outlines.size(), y.outlines.size());
}

constexpr RequestedOutputs kAll = {.levels = true, .normals = true};

TEST(ModelRunner, ReusedMapsEqualComputedOnes) {
  WorkerPool pool(2);
  Computed last;
  last.result.frame = ball_frame({96, 80});
  ModelRunner(pool).compute(with_kernel(9), kAll, nullptr, last);
  ASSERT_TRUE(last.error.empty()) << last.error;

  Settings fewer = with_kernel(9), other = with_kernel(11), wta = with_kernel(9);
  fewer.fixations = 1;
  wta.selector = Selector::wta;
  ModelRunner runner(pool);
  for (const Settings& settings : {with_kernel(9), fewer, wta, other}) {
    Computed kept, fresh;
    kept.result.frame = fresh.result.frame = last.result.frame;
    runner.compute(settings, kAll, &last, kept);
    ModelRunner(pool).compute(settings, kAll, nullptr, fresh);
    expect_same(kept, fresh);
    EXPECT_EQ(has_maps(last, settings, kAll), settings.kernel == 9);
    EXPECT_EQ(kept.result.times[Stage::symmetry] > 0, settings.kernel != 9) << "computed only if it must be";
  }
  EXPECT_FALSE(has_maps(last, with_kernel(9), {})) << "with other by-products";
}

TEST(ModelRunner, EverySettingOfTheModelMakesAMapStaleAndNoOther) {
  Computed of;
  of.result.frame = ball_frame({256, 256});
  for (const SettingSpec& spec : setting_specs())
    EXPECT_EQ(has_maps(of, changed(spec), {}), spec.scope != SettingScope::model) << spec.key;
}

TEST(ModelRunner, EverySettingOfAttentionMakesThePointsStaleAndNoOther) {
  WorkerPool pool(1);
  Computed last;
  last.result.frame = ball_frame({128, 128});
  ModelRunner(pool).compute(Settings{}, {}, nullptr, last);
  for (const SettingSpec& spec : setting_specs()) {
    if (spec.scope == SettingScope::model) continue;
    Computed next;
    next.result.frame = last.result.frame;
    ModelRunner(pool).compute(changed(spec), {}, &last, next);
    EXPECT_EQ(next.result.times[Stage::symmetry], 0) << spec.key;
    EXPECT_EQ(next.result.times[Stage::attention] > 0, spec.scope == SettingScope::attention) << spec.key;
  }
}

TEST(ModelRunner, ComputesTheSameAfterAnInterruption) {
  WorkerPool pool(2);
  ModelRunner runner(pool);
  Computed out, fresh;
  out.result.frame = fresh.result.frame = ball_frame({96, 80});
  runner.compute(with_kernel(7), {}, nullptr, out);
  pool.interrupt();
  EXPECT_THROW(runner.compute(with_kernel(21), {}, nullptr, out), WorkerPool::Interrupted);
  pool.resume();
  runner.compute(with_kernel(21), {}, nullptr, out);
  ModelRunner(pool).compute(with_kernel(21), {}, nullptr, fresh);
  expect_same(out, fresh);
}

TEST(Draft, IsOfCoarserLevelsWhereItTakesLong) {
  struct Case {
    int kernel;
    cv::Size size;
    int draft_kernel, first_level, last_level;  // kernel 0: no draft
  };
  for (const Case& c :
       {Case{15, {640, 480}, 0, 0, 0}, Case{21, {640, 480}, 0, 0, 0}, Case{25, {640, 480}, 12, 1, 5},
        Case{91, {640, 480}, 45, 1, 5}, Case{127, {640, 480}, 31, 2, 6}, Case{127, {64, 48}, 0, 0, 0},
        Case{127, {1920, 1080}, 31, 2, 6}, Case{15, {1920, 1080}, 7, 1, 5}}) {
    const auto draft = draft_of(with_kernel(c.kernel), c.size);
    SCOPED_TRACE(testing::Message() << "k " << c.kernel << ", " << c.size);
    ASSERT_EQ(draft.has_value(), c.draft_kernel > 0);
    if (!draft) continue;
    EXPECT_EQ(draft->kernel, c.draft_kernel);
    EXPECT_EQ(draft->first_level, c.first_level);
    EXPECT_EQ(draft->last_level, c.last_level);
  }
  Settings settings = with_kernel(127);
  settings.model = "itti";
  EXPECT_FALSE(draft_of(settings, {640, 480})) << "it has no levels to begin with";
}

class InteractiveProcessorTest : public ::testing::Test {
 protected:
  void process(InteractiveProcessor& processor, std::int64_t index) {
    Result result;
    result.frame = ball_frame({160, 120}, index);
    processor.process(result);
  }
  Computed expected(const Settings& settings) {
    WorkerPool pool(2);
    Computed computed;
    computed.result.frame = ball_frame({160, 120});
    ModelRunner(pool).compute(settings, {}, nullptr, computed);
    return computed;
  }
  InteractiveProcessor::Hooks hooks() {
    return {[] {},
            [this](std::shared_ptr<ViewResult> result) {
              published_.push_back(result);
              if (on_publish_) on_publish_();
            }};
  }

  std::vector<std::shared_ptr<ViewResult>> published_;
  std::function<void()> on_publish_;
};

TEST_F(InteractiveProcessorTest, PublishesADraftAndThenTheExactMap) {
  const Settings slow = with_kernel(127);
  ASSERT_TRUE(draft_of(slow, {160, 120}));
  InteractiveProcessor processor({slow, {}, {}}, 1, false, hooks());
  process(processor, 0);
  ASSERT_EQ(published_.size(), 2U);
  EXPECT_TRUE(published_[0]->draft && published_[0]->a.draft);
  expect_same(published_[0]->a, expected(*draft_of(slow, {160, 120})));
  EXPECT_FALSE(published_[1]->draft || published_[1]->a.draft);
  expect_same(published_[1]->a, expected(slow));
  process(processor, 0);
  EXPECT_EQ(published_.size(), 2U) << "the same again";
  process(processor, 1);
  ASSERT_EQ(published_.size(), 3U) << "no drafts where only the frame is new";
  EXPECT_FALSE(published_[2]->draft);
}

TEST_F(InteractiveProcessorTest, WhatDidNotChangeIsNotComputedAgain) {
  Settings slow = with_kernel(127), fast = with_kernel(7);
  InteractiveProcessor processor({fast, slow, {}}, 1, false, hooks());
  process(processor, 0);
  ASSERT_EQ(published_.size(), 2U);
  EXPECT_FALSE(published_[0]->a.draft);
  EXPECT_TRUE(published_[0]->b.draft);
  EXPECT_EQ(published_[1]->a.result.times[Stage::symmetry], 0) << "taken from the draft";
  fast.kernel = 9;
  processor.set_compute_request({fast, slow, {}}, 2);
  process(processor, 0);
  ASSERT_EQ(published_.size(), 3U) << "B is there: no draft";
  EXPECT_EQ(published_[2]->b.result.times[Stage::symmetry], 0);
  expect_same(published_[2]->a, expected(fast));
  expect_same(published_[2]->b, expected(slow));
}

TEST_F(InteractiveProcessorTest, ANewRequestComesBeforeTheExactMapOfAnOldOne) {
  InteractiveProcessor processor({with_kernel(127), {}, {}}, 1, false, hooks());
  on_publish_ = [&] {
    if (published_.size() == 1) processor.set_compute_request({with_kernel(9), {}, {}}, 2);
  };
  process(processor, 0);
  ASSERT_EQ(published_.size(), 2U) << "a draft of the old, the whole of the new";
  EXPECT_EQ(published_[1]->generation, 2);
  expect_same(published_[1]->a, expected(with_kernel(9)));
  on_publish_ = [&] { processor.stop(); };
  processor.set_compute_request({with_kernel(127), {}, {}}, 3);
  process(processor, 0);
  EXPECT_EQ(published_.size(), 3U) << "stopped after the draft";
}

// Frames of one sequence: a recording of three balls.
class SequenceTest : public ::testing::Test {
 protected:
  static Settings settings(int kernel) {
    Settings settings = with_kernel(kernel);
    settings.min_confidence = 0;
    return settings;
  }

  static Frame frame(std::int64_t index) {
    Frame frame;
    frame.index = index;
    frame.timestamp_us = index * 33'333;
    const cv::Size size(320, 240);
    frame.intrinsics = Intrinsics::guess_for(size);
    frame.depth_mm.create(size);
    const std::array<cv::Point, 3> balls = {{{70, 60}, {160, 160}, {250, 80}}};
    for (int r = 0; r < size.height; ++r)
      for (int c = 0; c < size.width; ++c) {
        float z = 1500 + static_cast<float>(r);
        for (const cv::Point& ball : balls)
          if (const double d = std::hypot(r - ball.y, c - ball.x); d < 30)
            z = 1000 - static_cast<float>(4 * std::sqrt(900 - d * d));
        frame.depth_mm(r, c) = z;
      }
    return frame;
  }

  // A ball of which little is seen to be round.
  static void flatten(cv::Point ball, cv::Mat1f& depth_mm) {
    for (int r = ball.y - 30; r <= ball.y + 30; ++r)
      for (int c = ball.x - 30; c <= ball.x + 30; ++c)
        if (depth_mm(r, c) < 1001) depth_mm(r, c) = 1000 - (1000 - depth_mm(r, c)) / 6;
  }

  // Computes a frame and returns side A of the newest result.
  const Computed& see(InteractiveProcessor& processor, std::int64_t index) {
    Result result;
    result.frame = frame(index);
    if (flat_) flatten(*flat_, result.frame.depth_mm);
    processor.process(result);
    return newest_->a;
  }

  static std::vector<int> ids(const Computed& computed) {
    std::vector<int> ids;
    for (const Fixation& fixation : computed.result.attention.fixations) ids.push_back(fixation.id);
    return ids;
  }

  InteractiveProcessor::Hooks hooks() {
    return {[] {}, [this](std::shared_ptr<ViewResult> result) { newest_ = std::move(result); },
            [this] { return jump_; }};
  }

  std::shared_ptr<ViewResult> newest_;
  PlayJump jump_;
  std::optional<cv::Point> flat_;
};

TEST_F(SequenceTest, ObjectsKeepTheirIdsAndHaveMarks) {
  InteractiveProcessor processor({settings(9), {}, {}}, 1, true, hooks());
  const std::vector<int> first = ids(see(processor, 0));
  ASSERT_GE(first.size(), 3U);
  EXPECT_EQ(first[0], 1);
  for (int k = 1; k < 4; ++k) {
    const Computed& now = see(processor, k);
    EXPECT_THAT(ids(now), ::testing::UnorderedElementsAreArray(first));
    EXPECT_EQ(ids(now)[0], first[0]);
    ASSERT_TRUE(now.marks);
    EXPECT_EQ(now.marks->marks.size(), now.result.attention.fixations.size());
    EXPECT_EQ(now.result.attention.fixations[0].age_frames, k + 1);
  }
}

TEST_F(SequenceTest, FramesThatAreNoSequenceStandForThemselves) {
  for (const bool off : {false, true}) {
    Settings alone = settings(9);
    if (off) alone.tracking = Tracking::off;
    InteractiveProcessor processor({alone, {}, {}}, 1, off, hooks());
    EXPECT_FALSE(see(processor, 0).marks);
    EXPECT_EQ(newest_->a.result.attention.fixations.at(0).id, 0);
    EXPECT_FALSE(newest_->a.result.attention.sequence);
  }
}

TEST_F(SequenceTest, TuningAFrameDoesNotAdvanceTheMemory) {
  InteractiveProcessor plain({settings(9), {}, {}}, 1, true, hooks());
  for (int k = 0; k < 3; ++k) see(plain, k);
  const auto untouched = newest_;
  see(plain, 3);
  const auto next = newest_;

  InteractiveProcessor tuned({settings(9), {}, {}}, 1, true, hooks());
  for (int k = 0; k < 3; ++k) see(tuned, k);
  for (int generation = 2; generation < 6; ++generation) {
    tuned.set_compute_request({settings(generation % 2 == 0 ? 15 : 9), {}, {}}, generation);
    see(tuned, 2);
    EXPECT_EQ(newest_->generation, generation);
    EXPECT_EQ(newest_->a.result.attention.fixations.at(0).age_frames, 3);
    EXPECT_FALSE(newest_->a.result.attention.sequence->cut);
  }
  expect_same(newest_->a, untouched->a);
  EXPECT_EQ(ids(newest_->a), ids(untouched->a));
  see(tuned, 3);
  expect_same(newest_->a, next->a);
  EXPECT_EQ(ids(newest_->a), ids(next->a));
  EXPECT_EQ(newest_->a.result.attention.sequence->gaze, next->a.result.attention.sequence->gaze);
}

TEST_F(SequenceTest, AJumpIsACutWhenItsFrameComes) {
  InteractiveProcessor processor({settings(9), {}, {}}, 1, true, hooks());
  see(processor, 0);
  see(processor, 1);
  jump_ = {1, 50};
  EXPECT_FALSE(see(processor, 2).result.attention.sequence->cut) << "it was read before the jump";
  EXPECT_TRUE(see(processor, 50).result.attention.sequence->cut);
  EXPECT_FALSE(see(processor, 51).result.attention.sequence->cut);
  EXPECT_TRUE(see(processor, 10).result.attention.sequence->cut) << "back";
}

TEST_F(SequenceTest, BothSidesOfAComparisonHaveTheSameIds) {
  Settings three = settings(9), other = settings(15);
  three.fixations = other.fixations = 3;  // the balls
  InteractiveProcessor processor({three, {}, {}}, 1, true, hooks());
  for (int k = 0; k < 3; ++k) see(processor, k);
  processor.set_compute_request({three, other, {}}, 2);
  for (int k = 3; k < 6; ++k) {
    see(processor, k);
    ASSERT_TRUE(newest_->compared && newest_->b.marks);
    std::vector<int> a = ids(newest_->a), b = ids(newest_->b);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b);
  }
}

TEST_F(SequenceTest, WhatBothSidesOfAComparisonSeeHasOneNumberFromTheFirstFrame) {
  Settings three = settings(9), other = settings(9);
  three.fixations = other.fixations = 3;
  other.model = "centre";
  flat_ = {160, 160};  // the ball in the middle: first for B, last for A
  InteractiveProcessor processor({three, other, {}}, 1, true, hooks());
  const auto expect_one_number = [&] {
    const std::vector<Fixation>&a = newest_->a.result.attention.fixations,
          &b = newest_->b.result.attention.fixations;
    ASSERT_EQ(b.size(), 3U);
    for (const Fixation& fixation : b) {
      const auto same = std::ranges::find(a, fixation.id, &Fixation::id);
      ASSERT_NE(same, a.end()) << fixation.id;
      EXPECT_LT(std::hypot(same->row - fixation.row, same->col - fixation.col), 40) << fixation.id;
    }
    EXPECT_NE(ids(newest_->a), ids(newest_->b));
    const auto gaze = newest_->b.result.attention.sequence->gaze;
    ASSERT_TRUE(gaze);
    EXPECT_EQ(std::ranges::count(b, *gaze, &Fixation::id), 1);
  };
  for (int k = 0; k < 4; ++k) {
    see(processor, k);
    expect_one_number();
    if (k == 0) {
      EXPECT_EQ(newest_->b.result.attention.sequence->gaze, ids(newest_->b).at(0));
    }
  }
  // B's points are taken over from the result before, A's are new.
  three.kernel = 15;
  processor.set_compute_request({three, other, {}}, 2);
  see(processor, 3);
  expect_one_number();
}

TEST_F(SequenceTest, ASequenceThatBeginsAgainHasTheSameIdsOnBothSides) {
  Settings few = settings(9);
  few.fixations = 3;
  InteractiveProcessor processor({few, settings(9), {}}, 1, true, hooks());  // B finds more objects
  const std::vector<int> a = ids(see(processor, 0)), b = ids(newest_->b);
  ASSERT_GT(b.size(), a.size());
  see(processor, 1);
  see(processor, 0);  // a loop
  EXPECT_TRUE(newest_->a.result.attention.sequence->cut);
  EXPECT_EQ(ids(newest_->a), a);
  EXPECT_EQ(ids(newest_->b), b);
}

TEST_F(SequenceTest, AfterAJumpForwardBothSidesCountOnFromTheSameId) {
  Settings few = settings(9);
  few.fixations = 3;
  InteractiveProcessor processor({few, settings(9), {}}, 1, true, hooks());
  see(processor, 0);
  const std::vector<int> b = ids(newest_->b);
  const int largest = *std::max_element(b.begin(), b.end());
  jump_ = {1, 50};
  see(processor, 50);
  EXPECT_EQ(ids(newest_->a).at(0), largest + 1);
  EXPECT_EQ(ids(newest_->b).at(0), largest + 1);
}

}  // namespace
}  // namespace saccade
