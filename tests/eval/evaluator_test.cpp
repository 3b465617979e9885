#include "eval/evaluator.hpp"

#include <gtest/gtest.h>

#include "eval/hit_ratio.hpp"
#include "saliency/symmetry3d.hpp"
#include "sources/synthetic_source.hpp"

namespace saccade {
namespace {

Frame table_frame() {
  SyntheticSource source("synthetic:table?noise=kinect&size=160x120&seed=2");
  Frame frame;
  EXPECT_EQ(source.read(frame, std::chrono::milliseconds(0)).status, ReadStatus::frame);
  return frame;
}

EvalPlan small_plan() {
  EvalPlan plan;
  plan.settings.last_level = 2;
  plan.points = 5;
  parse_lists(plan, "symmetry3d", "9,15", "proto,wta");
  return plan;
}

// Each condition computed by itself, with objects made for it.
TEST(Evaluator, PointsAreThoseOfModelAndSelector) {
  const Frame frame = table_frame();
  const EvalPlan plan = small_plan();
  WorkerPool pool(1);
  Evaluator evaluator(plan, pool);
  const ImageResult result = evaluator.evaluate(frame);
  EXPECT_EQ(result.left_out, std::nullopt);
  EXPECT_EQ(result.objects, static_cast<int>(object_areas(frame.truth.labels).size()));
  EXPECT_EQ(result.random, random_hit_ratio(frame.truth.labels, 5));
  const auto conditions = plan.conditions();
  ASSERT_EQ(result.conditions.size(), conditions.size());
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    SCOPED_TRACE(describe(conditions[i]));
    const Settings settings = plan.settings_of(conditions[i]);
    Symmetry3d model(settings, pool);
    SaliencyMaps maps;
    StageTimes times;
    Attention attention;
    model.compute(frame.depth_mm, frame.intrinsics, {}, maps, times);
    make_selector(settings)->select(maps.master, frame.depth_mm, frame.intrinsics, attention);
    const auto& points = result.conditions[i].points;
    ASSERT_EQ(points.size(), attention.fixations.size());
    ASSERT_FALSE(points.empty());
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(points[k].row, attention.fixations[k].row);
      EXPECT_EQ(points[k].col, attention.fixations[k].col);
      EXPECT_EQ(points[k].label, frame.truth.labels(points[k].row, points[k].col));
    }
    EXPECT_EQ(evaluator.compute(frame, i).attention.fixations.size(), points.size());
  }
}

// With classes every model gives up to kVoidReserve times as many points, the same ones first, and those on
// unlabelled pixels of class 0 are void.
TEST(Evaluator, ClassesSeparateVoidFromStructure) {
  Frame frame = table_frame();
  const EvalPlan plan = small_plan();
  WorkerPool pool(1);
  const ImageResult without = Evaluator(plan, pool).evaluate(frame);
  EXPECT_FALSE(without.void_known);
  frame.truth.classes = cv::Mat1w(frame.size(), std::uint16_t{0});
  frame.truth.classes.rowRange(60, 120).setTo(2);
  const ImageResult with = Evaluator(plan, pool).evaluate(frame);
  EXPECT_TRUE(with.void_known);
  int on_void = 0;
  bool has_more = false;
  for (std::size_t i = 0; i < with.conditions.size(); ++i) {
    const auto &few = without.conditions[i].points, &many = with.conditions[i].points;
    ASSERT_GE(many.size(), few.size());
    has_more = has_more || many.size() > few.size();
    ASSERT_LE(many.size(), static_cast<std::size_t>(kVoidReserve * plan.points));
    for (std::size_t k = 0; k < many.size(); ++k) {
      if (k < few.size()) {
        EXPECT_EQ(cv::Point(many[k].col, many[k].row), cv::Point(few[k].col, few[k].row));
      }
      const int label = frame.truth.labels(many[k].row, many[k].col);
      EXPECT_EQ(many[k].label, label == 0 && many[k].row < 60 ? kVoid : label);
      on_void += many[k].label == kVoid;
    }
  }
  EXPECT_GT(on_void, 0);
  EXPECT_TRUE(has_more);
}

TEST(Evaluator, AFrameWithoutLabelsIsLeftOut) {
  Frame frame = table_frame();
  frame.truth.labels.release();
  WorkerPool pool(1);
  const EvalPlan plan = small_plan();
  const ImageResult result = Evaluator(plan, pool).evaluate(frame);
  EXPECT_EQ(result.left_out, "it has no label image");
  EXPECT_TRUE(result.conditions.empty());
}

}  // namespace
}  // namespace saccade
