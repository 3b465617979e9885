// Zoom and pan, the time line, and the drawings over a picture.
#include <cmath>

#include <gtest/gtest.h>

#include "ui/session/overlay_shapes.hpp"
#include "ui/session/picture_view.hpp"
#include "ui/session/timeline.hpp"

namespace saccade {
namespace {

TEST(PictureView, FitsAndFollowsThePanelUntilItIsMoved) {
  PictureView view;
  view.layout({1280, 960}, {640, 480});
  EXPECT_DOUBLE_EQ(view.scale(), 2);
  EXPECT_EQ(view.to_panel({0, 0}), cv::Point2d(0, 0));
  view.layout({640, 960}, {640, 480});
  EXPECT_DOUBLE_EQ(view.scale(), 1);
  EXPECT_EQ(view.to_panel({320, 240}), cv::Point2d(320, 480));
  view.pan({10, 0});
  view.layout({1280, 960}, {640, 480});
  EXPECT_DOUBLE_EQ(view.scale(), 1) << "its zoom is a person's now";
  view.layout({1280, 960}, {320, 240});
  EXPECT_TRUE(view.fitted()) << "another picture";
}

TEST(PictureView, ZoomKeepsWhatIsUnderTheMouse) {
  PictureView view;
  view.layout({800, 600}, {640, 480});
  const cv::Point2d mouse(123, 456), before = view.to_picture(mouse);
  for (const double factor : {1.5, 2.0, 0.7}) {
    view.zoom(factor, mouse);
    EXPECT_NEAR(cv::norm(view.to_picture(mouse) - before), 0, 1e-9);
  }
  const cv::Point2d at = view.to_picture({400, 300});
  view.pan({20, -10});
  EXPECT_NEAR(cv::norm(view.to_picture({420, 290}) - at), 0, 1e-9) << "the picture follows the hand";
}

TEST(PictureView, CannotBeLostOrZoomedWithoutEnd) {
  PictureView view;
  view.layout({800, 600}, {640, 480});
  for (int i = 0; i < 100; ++i) view.zoom(2, {400, 300});
  EXPECT_DOUBLE_EQ(view.scale(), PictureView::kLargestZoom);
  for (int i = 0; i < 100; ++i) view.zoom(0.5, {400, 300});
  EXPECT_GT(view.scale(), 0.3);
  view.pan({1e6, 1e6});
  const cv::Point2d middle = view.to_picture({400, 300});
  EXPECT_GE(middle.x, 0);
  EXPECT_GE(middle.y, 0);
}

TEST(Timeline, PlacesAndFramesAgree) {
  for (const VisibleFrames& visible : {VisibleFrames{0, 1}, {0, 7}, {0, 1000}, {12.5, 30}}) {
    const auto end = static_cast<std::int64_t>(visible.first + visible.count);
    for (auto i = static_cast<std::int64_t>(std::ceil(visible.first)); i < end; ++i)
      EXPECT_EQ(frame_at(frame_x(i, 500, visible), 500, visible), i);
  }
  EXPECT_EQ(frame_at(-5, 500, {0, 10}), 0);
  EXPECT_EQ(frame_at(900, 500, {0, 10}), 9);
  EXPECT_EQ(frame_at(-5, 500, {20, 10}), 20);
  EXPECT_EQ(frame_at(900, 500, {20, 10}), 29);
  EXPECT_EQ(frame_at(5, 500, {}), 0);
}

TEST(Timeline, TicksDoNotTouch) {
  EXPECT_EQ(tick_step(500, {0, 10}, 40), 1);
  EXPECT_EQ(tick_step(500, {0, 100}, 40), 10);
  EXPECT_EQ(tick_step(500, {0, 15000}, 40), 2000);
  for (double frames = 1; frames < 3000; frames += 7)
    EXPECT_GE(static_cast<double>(tick_step(500, {50, frames}, 40)) * 500 / frames, 40);
}

TEST(TimelineZoom, KeepsThePlaceUnderTheMouse) {
  TimelineZoom zoom;
  EXPECT_FALSE(zoom.zoomed());
  EXPECT_EQ(zoom.visible(1000).count, 1000);
  zoom.zoom(3, 0.25, 1000);
  const VisibleFrames visible = zoom.visible(1000);
  EXPECT_LT(visible.count, 600);
  EXPECT_NEAR(visible.first + 0.25 * visible.count, 250, 1e-9);
  zoom.zoom(100, 0.25, 1000);
  EXPECT_EQ(zoom.visible(1000).count, 10);
  zoom.zoom(-100, 0.9, 1000);
  EXPECT_FALSE(zoom.zoomed());
  zoom.zoom(5, 0.5, 4);
  EXPECT_EQ(zoom.visible(4).count, 4) << "so few frames are always all visible";
}

TEST(TimelineZoom, StaysInsideAndFollowsNewFrames) {
  TimelineZoom zoom;
  zoom.zoom(3, 0, 1000);
  const double count = zoom.visible(1000).count;
  zoom.pan(-5, 1000);
  EXPECT_EQ(zoom.visible(1000).first, 0);
  zoom.pan(50, 1000);
  EXPECT_EQ(zoom.visible(1000).first, 1000 - count);
  zoom.follow(40, 1000);
  EXPECT_EQ(zoom.visible(1000).first, 40);
  zoom.pan(0.5, 1000);
  const double moved = zoom.visible(1000).first;
  zoom.follow(40, 1000);
  EXPECT_EQ(zoom.visible(1000).first, moved) << "the user may look elsewhere while the frame stays";
  zoom.follow(41, 1000);
  EXPECT_EQ(zoom.visible(1000).first, 41);
}

TEST(Timeline, FramesOfOneColumnShareABar) {
  Timeline line;
  line.reset(1000);
  for (std::int64_t i = 0; i < 1000; ++i) line.add(i, i == 3 ? 9.0F : 1.0F, i != 3);
  line.add(7, 5, true);
  const auto bars = timeline_bars(line.entries(), {0, 1000}, 100);
  ASSERT_EQ(bars.size(), 100U);
  EXPECT_EQ(bars[0].strength, 5) << "the strongest of the current ones";
  EXPECT_TRUE(bars[0].current);
  EXPECT_EQ(bars[1].strength, 1);
  EXPECT_EQ(timeline_bars(line.entries(), {0, 10}, 100).size(), 10U);
  EXPECT_EQ(timeline_bars(line.entries(), {995, 10}, 100).size(), 5U) << "there are no more";
}

TEST(Timeline, RemembersFramesAndScalesByTheCurrentOnes) {
  Timeline line;
  line.reset(4);
  line.add(1, 2.5F, true);
  line.add(3, 0.5F, true);
  EXPECT_FLOAT_EQ(line.largest(), 2.5F);
  line.age();
  EXPECT_FLOAT_EQ(line.largest(), 2.5F) << "better old ones than none";
  line.add(3, 1, true);
  EXPECT_FLOAT_EQ(line.largest(), 1);
  EXPECT_FALSE(line.entries()[0].seen);
  EXPECT_TRUE(line.entries()[1].seen && !line.entries()[1].current);
  line.add(9, 1, true);
  EXPECT_EQ(line.entries().size(), 10u) << "a recording without a known length grows";
  line.add(-1, 1, true);
  line.add(std::int64_t{1} << 40, 1, true);
  EXPECT_EQ(line.entries().size(), 10u) << "a wrong index costs no memory";
}

class ShapesTest : public ::testing::Test {
 protected:
  ShapesTest() {
    computed_.result.attention.fixations = {{10, 20, 1, {}, {}}, {30, 40, 0.5F, {}, {}}};
    computed_.outlines = {{2, {{30, 20}, {50, 20}, {50, 40}}}, {1, {{10, 5}, {30, 5}, {30, 15}}}};
    view_.layout({128, 96}, {64, 48});
  }
  Computed computed_;
  PictureView view_;
};

TEST_F(ShapesTest, FollowTheStyle) {
  OverlayStyle none;
  none.marks = none.path = none.outlines = false;
  const OverlayShapes empty = overlay_shapes(computed_, none, view_, 1);
  EXPECT_TRUE(empty.lines.empty() && empty.marks.empty());
  none.path = true;
  EXPECT_EQ(overlay_shapes(computed_, none, view_, 1).lines.size(), 2u) << "a line and its shadow";
  EXPECT_EQ(overlay_shapes(computed_, {}, view_, 1).lines.size(), 6u);
  EXPECT_EQ(overlay_shapes(computed_, {}, view_, 1).marks.size(), 2u);
}

TEST_F(ShapesTest, LieInTheMiddleOfTheirPixelsAndTheFirstIsOnTop) {
  const OverlayShapes shapes = overlay_shapes(computed_, {}, view_, 1);
  EXPECT_EQ(shapes.marks.back().text, "1");
  EXPECT_EQ(shapes.marks.back().centre, cv::Point2f(41, 21)) << "scale 2: (20.5, 10.5)";
  EXPECT_NE(shapes.marks.back().rim, shapes.marks.front().rim);
  EXPECT_TRUE(shapes.lines.front().closed);
  EXPECT_EQ(shapes.lines.front().points.front(), cv::Point2f(61, 41));
  EXPECT_FALSE(shapes.lines.back().closed) << "the scan path lies over the outlines";
}

TEST_F(ShapesTest, ADoubtfulFixationIsFaintWithItsOutline) {
  auto& first = computed_.result.attention.fixations[0];
  first.confidence = 0.8F;
  const OverlayShapes sure = overlay_shapes(computed_, {}, view_, 1);
  first.confidence = 0.2F;
  const OverlayShapes doubtful = overlay_shapes(computed_, {}, view_, 1);
  EXPECT_LT(doubtful.marks.back().rim.a, sure.marks.back().rim.a / 2);
  EXPECT_LT(doubtful.lines[3].colour.a, sure.lines[3].colour.a / 2) << "the outline of rank 1 is drawn last";
  EXPECT_EQ(doubtful.marks.front().rim, sure.marks.front().rim);
}

TEST_F(ShapesTest, OverTimeObjectsHaveTheirNumbersAndTheGazeARing) {
  Attention& attention = computed_.result.attention;
  attention.sequence.emplace();
  attention.sequence->gaze = 12;
  attention.fixations[0].id = 7;
  attention.fixations[1].id = 12;
  computed_.marks.emplace();
  computed_.marks->marks = {{{20.25, 10.5}, true, 1, 1}, {{40.5, 30.5}, false, 1, 1}};
  computed_.marks->trail = {{20.25, 10.5}, {40.5, 30.5}};
  OverlayStyle style;
  style.outlines = false;
  const OverlayShapes shapes = overlay_shapes(computed_, style, view_, 1);
  EXPECT_EQ(shapes.marks.back().text, "7");
  EXPECT_EQ(shapes.marks.front().text, "12");
  EXPECT_EQ(shapes.marks.back().centre, cv::Point2f(40.5F, 21)) << "between pixels";
  EXPECT_LT(shapes.marks.back().rim.a, shapes.marks.front().rim.a) << "it was looked at";
  ASSERT_EQ(shapes.rings.size(), 1U);
  EXPECT_EQ(shapes.rings.front().centre, shapes.marks.front().centre);
  ASSERT_EQ(shapes.lines.size(), 1U) << "the trail";
  EXPECT_EQ(shapes.lines.front().points.back(), shapes.rings.front().centre);
}

TEST_F(ShapesTest, MarksAtTheEdgeOfThePictureAreWhole) {
  computed_.result.attention.fixations[0].row = 0;
  computed_.result.attention.fixations[1].col = 63;
  for (const double unit : {1.0, 2.0})
    for (const OverlayShapes::Mark& mark : overlay_shapes(computed_, {}, view_, unit).marks) {
      const cv::Point2f low = view_.to_panel({0, 0}), high = view_.to_panel({64, 48});
      EXPECT_GE(std::min(mark.centre.x - low.x, mark.centre.y - low.y), mark.radius);
      EXPECT_GE(std::min(high.x - mark.centre.x, high.y - mark.centre.y), mark.radius);
    }
}

TEST(PictureView, WhatIsInsideStaysWhereItIs) {
  PictureView view;
  view.layout({1280, 960}, {640, 480});
  EXPECT_EQ(view.inside({300, 200}, 10), cv::Point2d(300, 200));
  EXPECT_EQ(view.inside({-50, 955}, 10), cv::Point2d(10, 950));
  view.layout({8, 6}, {640, 480});
  EXPECT_EQ(view.inside({0, 0}, 10), cv::Point2d(0, 0)) << "there is no room";
}

TEST_F(ShapesTest, AMarkIsFoundUnderTheMouse) {
  OverlayShapes shapes = overlay_shapes(computed_, {}, view_, 1);
  EXPECT_EQ(mark_under(shapes, {41, 21}), 0);
  EXPECT_EQ(mark_under(shapes, {81, 61}), 1);
  EXPECT_EQ(mark_under(shapes, {0, 0}), -1);
  shapes.marks[0].centre = shapes.marks[1].centre;
  EXPECT_EQ(mark_under(shapes, {41, 21}), 0) << "the one on top";
}

}  // namespace
}  // namespace saccade
