// The computation of the viewer's results: reused parts, drafts and interrupted computations give the same
// results as a single computation.
#include "ui/session/model_runner.hpp"

#include <cmath>
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
  InteractiveProcessor processor({slow, {}, {}}, 1, hooks());
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
  InteractiveProcessor processor({fast, slow, {}}, 1, hooks());
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
  InteractiveProcessor processor({with_kernel(127), {}, {}}, 1, hooks());
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

}  // namespace
}  // namespace saccade
