#include "eval/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Drawing sample_figure(const EvalPlan& plan) {
  return draw_hit_ratios(plan, summarise(plan, sample_images()));
}

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(Figure, ShowsAxesLegendAndBound) {
  const std::string svg = to_svg(sample_figure(sample_plan()));
  EXPECT_THAT(svg, HasSubstr("number of attention points n"));
  EXPECT_THAT(svg, HasSubstr("Hit Ratio HR(n)"));
  EXPECT_THAT(svg, HasSubstr(">upper bound<"));
  EXPECT_THAT(svg, HasSubstr(">random (expected)<"));
  EXPECT_THAT(svg, HasSubstr(">centre (expected)<"));
  EXPECT_THAT(svg, HasSubstr("2 images, 1.5 objects each; shaded"));
  // One model, two kernels: a panel for each selector compares the kernels.
  EXPECT_EQ(occurrences(svg, ">symmetry3d, proto<"), 1);
  EXPECT_EQ(occurrences(svg, ">symmetry3d, wta<"), 1);
  EXPECT_EQ(occurrences(svg, ">k = 10<"), 1);
}

TEST(Figure, KernelsWithoutEffectHaveNoPanels) {
  const EvalPlan plan = sample_plan();
  auto images = sample_images();
  for (ImageResult& image : images)
    if (!image.left_out)
      for (auto& condition : image.conditions) condition = image.conditions[0];
  const std::string svg = to_svg(draw_hit_ratios(plan, summarise(plan, images)));
  EXPECT_THAT(svg, HasSubstr(">k = 10, proto<"));
  EXPECT_THAT(svg, HasSubstr(">k = 15, wta<"));
  EXPECT_THAT(svg, Not(HasSubstr(">symmetry3d, proto<")));
}

TEST(Figure, StaysOnItsSheet) {
  const Drawing drawing = sample_figure(sample_plan());
  const cv::Rect2d sheet(0, 0, drawing.width, drawing.height);
  for (const auto& shape : drawing.shapes) {
    if (const auto* line = std::get_if<Line>(&shape))
      for (const cv::Point2d& p : line->points) {
        EXPECT_TRUE(sheet.contains(p)) << p;
      }
    if (const auto* text = std::get_if<Text>(&shape)) {
      EXPECT_TRUE(sheet.contains(text->position)) << text->text;
    }
  }
}

TEST(Drawing, SvgEscapesText) {
  const Drawing drawing{10, 10, {Text{{1, 2}, "a<b & \"c\"", 12, Anchor::end, {}}}};
  EXPECT_THAT(to_svg(drawing), HasSubstr(">a&lt;b &amp; &quot;c&quot;</text>"));
  EXPECT_THAT(to_svg(drawing), HasSubstr("text-anchor=\"end\""));
}

TEST(Drawing, PictureHasTheShapesWhereTheyAre) {
  const Drawing drawing{100,
                        50,
                        {Area{{{10, 10}, {30, 10}, {30, 30}, {10, 30}}, {0, 0, 255}, 1},
                         Line{{{0, 40}, {100, 40}}, {255, 0, 0}, 2, {10, 10}},
                         Area{{{60, 0}, {100, 0}, {100, 20}, {60, 20}}, {0, 0, 0}, 0.5}}};
  const cv::Mat3b picture = to_picture(drawing, 2);
  ASSERT_EQ(picture.size(), cv::Size(200, 100));
  EXPECT_EQ(picture(40, 40), cv::Vec3b(255, 0, 0)) << "blue area";
  EXPECT_EQ(picture(80, 10), cv::Vec3b(0, 0, 255)) << "red dash";
  EXPECT_EQ(picture(80, 30), cv::Vec3b(255, 255, 255)) << "gap of the dashes";
  EXPECT_EQ(picture(80, 50), cv::Vec3b(0, 0, 255)) << "next dash";
  EXPECT_NEAR(picture(20, 160)[0], 128, 1) << "half black";
  EXPECT_EQ(picture(95, 195), cv::Vec3b(255, 255, 255));
}

TEST(Drawing, TextUpwardsIsTurned) {
  const Drawing drawing{100, 100, {Text{{50, 50}, "MMMMMMMM", 12, Anchor::middle, {}, true}}};
  const cv::Mat3b picture = to_picture(drawing, 1);
  cv::Rect box;
  for (int r = 0; r < 100; ++r)
    for (int c = 0; c < 100; ++c)
      if (picture(r, c)[0] < 128) box |= cv::Rect(c, r, 1, 1);
  EXPECT_GT(box.height, 3 * box.width);
  EXPECT_NEAR(box.y + box.height / 2.0, 50, 4);
  EXPECT_LE(box.x + box.width, 53) << "the base line is on the right";
}

}  // namespace
}  // namespace saccade
