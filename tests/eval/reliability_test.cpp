#include "eval/reliability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "eval/hit_ratio.hpp"
#include "eval/page.hpp"
#include "eval/reliability_figure.hpp"
#include "eval/report.hpp"
#include "samples.hpp"

namespace saccade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Frame 0: a sure hit, a doubtful hit, void, and a hit after the third point, which does not count. Frame 2:
// a sure miss.
std::vector<ImageResult> images_with_confidence() {
  auto images = sample_images();
  images[0].void_known = true;
  images[0].conditions[0].points = {{1, 2, 4, 0.95F}, {3, 4, 5, 0.35F}, {5, 6, kVoid, 0.9F}, {7, 8, 4, 0.1F}};
  images[2].conditions[0].points = {{7, 8, 0, 0.5F}};
  return images;
}

TEST(Reliability, OfHandMadePoints) {
  const auto r = summarise(sample_plan(), images_with_confidence()).reliability[0];
  ASSERT_TRUE(r);
  EXPECT_EQ(r->points, 3U);
  EXPECT_EQ(r->sure, 2U);
  EXPECT_DOUBLE_EQ(r->precision, 0.5);
  EXPECT_DOUBLE_EQ(r->recall, 0.5);
  EXPECT_NEAR(r->brier, (0.05 * 0.05 + 0.65 * 0.65 + 0.5 * 0.5) / 3, 1e-6);
  EXPECT_EQ(r->bins[9].points, 1U);
  EXPECT_NEAR(r->bins[9].confidence, 0.95, 1e-6);
  EXPECT_EQ(r->bins[3].on_object, 1);
  EXPECT_EQ(r->bins[5].on_object, 0);
  EXPECT_EQ(r->bins[0].points, 0U);
}

TEST(Reliability, ThereIsNoneWithoutConfidences) {
  EXPECT_FALSE(summarise(sample_plan(), images_with_confidence()).reliability[1]);
}

TEST(Reliability, AConfidenceOfOneIsInTheLastBin) {
  auto images = images_with_confidence();
  images[0].conditions[0].points = {{1, 2, 4, 1.0F}};
  EXPECT_EQ(summarise(sample_plan(), images).reliability[0]->bins[9].points, 1U);
}

TEST(Reliability, IsInTheReports) {
  const auto plan = sample_plan();
  const auto images = images_with_confidence();
  const Statistics statistics = summarise(plan, images);
  const auto json = report_json(plan, statistics);
  EXPECT_EQ(json["conditions"][0]["confidence"]["precision"], 0.5);
  EXPECT_EQ(json["conditions"][0]["confidence"]["bins"][9]["points"], 1);
  EXPECT_FALSE(json["conditions"][1].contains("confidence"));
  EXPECT_THAT(report_text(plan, statistics),
              HasSubstr("symmetry3d, k = 10, proto                     3      2     0.500  0.500  0.225\n"));
  EXPECT_THAT(report_text(plan, summarise(plan, sample_images())), Not(HasSubstr("confidence")));
  EXPECT_THAT(page_html(plan, statistics, {"", "<svg>RELIABILITY</svg>"}, {}),
              HasSubstr("<svg>RELIABILITY</svg>"));
  EXPECT_THAT(page_html(plan, statistics, {"", ""}, {}), Not(HasSubstr("Confidence")));
}

// Five points of the same bin make a marker on the diagram, at their mean.
TEST(ReliabilityFigure, ShowsBinsWithEnoughPoints) {
  EvalPlan plan = sample_plan();
  plan.points = 10;
  auto images = images_with_confidence();
  for (ImageResult& image : images) image.random = image.centre = std::vector<double>(10, 0.1);
  images[0].conditions[0].points.assign(5, {1, 2, 4, 0.75F});
  images[2].conditions[0].points = {{7, 8, 0, 0.25F}};
  const auto drawing = draw_reliability(plan, summarise(plan, images));
  ASSERT_TRUE(drawing);
  std::vector<cv::Point2d> middles;
  for (const auto& shape : drawing->shapes)
    if (const auto* area = std::get_if<Area>(&shape)) {
      cv::Point2d sum;
      for (const cv::Point2d& corner : area->corners) sum += corner;
      middles.push_back(sum / static_cast<double>(area->corners.size()));
    }
  ASSERT_EQ(middles.size(), 2U) << "one in the diagram, one in the legend";
  EXPECT_NEAR(middles[0].x, 62 + 0.75 * 320, 0.1);
  EXPECT_NEAR(middles[0].y, 44, 0.1);
  EXPECT_THAT(to_svg(*drawing), HasSubstr("symmetry3d, k = 10, proto"));
  EXPECT_FALSE(draw_reliability(sample_plan(), summarise(sample_plan(), sample_images())));
}

}  // namespace
}  // namespace saccade
