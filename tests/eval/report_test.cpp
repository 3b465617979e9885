#include "eval/report.hpp"

#include <sstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "eval/hit_ratio.hpp"
#include "eval/page.hpp"
#include "samples.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Statistics, MeansOfHandMadeImages) {
  const Statistics statistics = summarise(sample_plan(), sample_images());
  EXPECT_EQ(statistics.images, 2U);
  EXPECT_EQ(statistics.without_objects, 0U);
  EXPECT_EQ(statistics.objects_mean, 1.5);
  EXPECT_EQ(statistics.objects_least, 1);
  EXPECT_EQ(statistics.objects_most, 2);
  EXPECT_THAT(statistics.bound.mean, ElementsAre(1, 0.75, (2 / 3.0 + 1 / 3.0) / 2));
  EXPECT_THAT(statistics.conditions[0].mean, ElementsAre(1, 0.75, (2 / 3.0 + 1 / 3.0) / 2));
  EXPECT_THAT(statistics.conditions[1].mean, ElementsAre(0.5, 0.25, (2 / 3.0) / 2));
  EXPECT_THAT(statistics.points_mean, ElementsAre(2, 1.5, 2, 1));
  EXPECT_THAT(statistics.map_ms, ElementsAre(20, 20, 30, 30));
  EXPECT_THAT(statistics.select_ms, ElementsAre(1, 3, 1, 4));
  EXPECT_NEAR(statistics.random.mean[0], 0.2, 1e-12);
  EXPECT_NEAR(statistics.centre.mean[0], 0.3, 1e-12);
}

TEST(Statistics, DifferencesArePairedAndOfOneThing) {
  const Statistics statistics = summarise(sample_plan(), sample_images());
  ASSERT_EQ(statistics.differences.size(), 4U) << "2 of kernels, 2 of selectors";
  const Difference& selectors = statistics.differences[0];
  EXPECT_EQ(selectors.a, 0U);
  EXPECT_EQ(selectors.b, 1U);
  EXPECT_DOUBLE_EQ(selectors.mean[0], 0.5);
  // Image by image 0 and 1: two images' samples give 0, 0.5 or 1.
  EXPECT_DOUBLE_EQ(selectors.interval[0].low, 0);
  EXPECT_DOUBLE_EQ(selectors.interval[0].high, 1);
}

TEST(Statistics, IntervalsHoldTheMean) {
  const Statistics statistics = summarise(sample_plan(), sample_images());
  for (const Curve& curve : statistics.conditions)
    for (std::size_t n = 0; n < curve.mean.size(); ++n) {
      EXPECT_LE(curve.interval[n].low, curve.mean[n]);
      EXPECT_GE(curve.interval[n].high, curve.mean[n]);
    }
}

// The sample, its first image with classes and one more point.
std::vector<ImageResult> images_with_void() {
  auto images = sample_images();
  images[0].void_known = true;
  images[0].conditions[0].points = {{1, 2, kVoid}, {3, 4, 4}, {5, 6, 0}, {7, 8, 5}};
  return images;
}

TEST(Statistics, VoidNeutralHitRatio) {
  EXPECT_TRUE(summarise(sample_plan(), sample_images()).void_neutral.empty());
  const Statistics statistics = summarise(sample_plan(), images_with_void());
  EXPECT_EQ(statistics.void_known, 1U);
  // Image 0: void 4 0 5 -> 0 1/2 1/3, without void 4 0 5 -> 1 1/2 2/3; image 2: 9 -> 1 1/2 1/3.
  EXPECT_THAT(statistics.conditions[0].mean, ElementsAre(0.5, 0.5, 1 / 3.0));
  EXPECT_THAT(statistics.void_neutral[0].mean, ElementsAre(1, 0.5, (2 / 3.0 + 1 / 3.0) / 2));
  EXPECT_EQ(statistics.void_neutral[1].mean, statistics.conditions[1].mean) << "no point on void";
  EXPECT_EQ(statistics.points_mean[0], 2) << "the reserve does not count";
}

TEST(Statistics, SharesOfWhatThePointsLieOn) {
  const Statistics statistics = summarise(sample_plan(), images_with_void());
  const PointShares& three = statistics.points_on[0][2];  // void 4 0 and 9 missing missing
  EXPECT_DOUBLE_EQ(three.new_object, 1 / 3.0);
  EXPECT_DOUBLE_EQ(three.same_object, 0);
  EXPECT_DOUBLE_EQ(three.structure, 1 / 6.0);
  EXPECT_DOUBLE_EQ(three.unlabelled, 1 / 6.0);
  EXPECT_DOUBLE_EQ(three.missing, 1 / 3.0);
  EXPECT_DOUBLE_EQ(statistics.points_on[1][1].same_object, 0.25) << "4 4 and nothing";
  for (std::size_t i = 0; i < statistics.conditions.size(); ++i)
    for (std::size_t n = 0; n < 3; ++n) {
      const PointShares& s = statistics.points_on[i][n];
      EXPECT_NEAR(s.new_object, statistics.conditions[i].mean[n], 1e-12);
      EXPECT_NEAR(s.new_object + s.same_object + s.structure + s.unlabelled + s.missing, 1, 1e-12);
    }
}

// Kernel 10 finds the object of even images only, kernel 15 that of odd images only: each is best on one
// half, and misses everything on the other.
TEST(Statistics, CrossValidationReportsTheOtherHalf) {
  EvalPlan plan;
  plan.points = 2;
  parse_lists(plan, "symmetry3d", "10,15", "proto");
  std::vector<ImageResult> images;
  for (int i = 0; i < 5; ++i) {
    ImageResult image{.frame = i, .left_out = {}, .objects = 1, .random = {0, 0}, .centre = {0, 0}};
    image.conditions = {{{{0, 0, i % 2 == 0 ? 1 : 0}}, 1, 1}, {{{0, 0, i % 2}}, 1, 1}};
    images.push_back(image);
  }
  images.insert(images.begin() + 1, {.frame = 9, .left_out = "not counted"});
  const Statistics statistics = summarise(plan, images);
  EXPECT_THAT(statistics.conditions[0].mean, ElementsAre(0.6, 0.3));
  EXPECT_THAT(statistics.halves[0][0], ElementsAre(1, 0.5));
  EXPECT_THAT(statistics.halves[0][1], ElementsAre(0, 0));
  EXPECT_THAT(statistics.halves[1][1], ElementsAre(1, 0.5));
  ASSERT_EQ(statistics.cross_validations.size(), 1U);
  const CrossValidation& validated = statistics.cross_validations[0];
  EXPECT_THAT(validated.used, ElementsAre(1, 0)) << "kernel 15, the best on odd images, on even ones";
  EXPECT_THAT(validated.curve.mean, ElementsAre(0, 0));
}

TEST(Statistics, CrossValidationOfOneConditionIsItsHitRatio) {
  EvalPlan plan = sample_plan();
  plan.kernels = {10};
  plan.selectors = {Selector::proto};
  auto images = sample_images();
  for (ImageResult& image : images)
    if (!image.left_out) image.conditions.resize(1);
  const Statistics statistics = summarise(plan, images);
  EXPECT_EQ(statistics.cross_validations[0].curve.mean, statistics.conditions[0].mean);
}

TEST(Statistics, NeedAnImage) {
  EXPECT_THROW(summarise(sample_plan(), {sample_images()[1]}), std::invalid_argument);
}

TEST(Statistics, ShownCounts) {
  EXPECT_THAT(shown_counts(30), ElementsAre(1, 2, 3, 5, 10, 20, 30));
  EXPECT_THAT(shown_counts(12), ElementsAre(1, 2, 3, 5, 10, 12));
  EXPECT_THAT(shown_counts(1), ElementsAre(1));
}

TEST(Report, CsvHasALinePerImageConditionAndN) {
  std::istringstream csv(csv_text(sample_plan(), sample_images()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1 + 2 * 4 * 3U);
  EXPECT_EQ(lines[0],
            "frame,name,model,kernel,selector,n,objects,found,hr,bound,same_object,structure,void,missing,"
            "hr_void_neutral");
  EXPECT_EQ(lines[1], "0,0000,symmetry3d,10,proto,1,2,1,1.000000,1.000000,0,0,,0,");
  EXPECT_EQ(lines[3], "0,0000,symmetry3d,10,proto,3,2,2,0.666667,0.666667,0,1,,0,");
  EXPECT_EQ(lines[12], "0,0000,symmetry3d,15,wta,3,2,1,0.333333,0.666667,0,0,,2,");
  EXPECT_EQ(lines[24], "2,\"a,\"\"b\"\"\",symmetry3d,15,wta,3,1,0,0.000000,0.333333,0,1,,2,");
}

TEST(Report, CsvOfAnImageWithClasses) {
  std::istringstream csv(csv_text(sample_plan(), images_with_void()));
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(csv, line);
  EXPECT_EQ(line, "0,0000,symmetry3d,10,proto,3,2,1,0.333333,0.666667,0,1,1,0,0.666667");
}

TEST(Report, JsonHoldsTheHonestFigures) {
  const auto plan = sample_plan();
  const auto images = images_with_void();
  const auto json = report_json(plan, summarise(plan, images));
  EXPECT_EQ(json["images_with_classes"], 1);
  const auto& condition = json["conditions"][0];
  EXPECT_EQ(condition["hr_void_neutral"][0]["mean"], 1);
  EXPECT_EQ(condition["points_on"][2]["void"], 0.166667);
  EXPECT_EQ(condition["points_on"][2]["missing"], 0.333333);
  EXPECT_EQ(condition["halves"]["even"][2]["mean"], 0.333333);
  EXPECT_EQ(json["cross_validation"][0]["even_images_under"]["kernel"], 10);
  EXPECT_EQ(json["cross_validation"][0]["hr"][0]["n"], 1);
  const auto without = report_json(plan, summarise(plan, sample_images()));
  EXPECT_FALSE(without["conditions"][0].contains("hr_void_neutral"));
  EXPECT_FALSE(without["conditions"][0]["points_on"][0].contains("void"));
}

TEST(Report, JsonHoldsAllFigures) {
  const auto plan = sample_plan();
  const auto images = sample_images();
  const auto json = report_json(plan, summarise(plan, images));
  EXPECT_EQ(json["images"], 2);
  ASSERT_EQ(json["left_out"].size(), 1U);
  EXPECT_EQ(json["left_out"][0]["frame"], 1);
  EXPECT_EQ(json["left_out"][0]["name"], "0001");
  EXPECT_THAT(json["left_out"][0]["reason"], HasSubstr("80x80"));
  EXPECT_EQ(json["objects_per_image"]["mean"], 1.5);
  EXPECT_EQ(json["bound"][1]["mean"], 0.75);
  EXPECT_EQ(json["baselines"]["random"][0]["mean"], 0.2);
  EXPECT_EQ(json["baselines"]["centre"][2]["n"], 3);
  ASSERT_EQ(json["conditions"].size(), 4U);
  EXPECT_EQ(json["conditions"][2]["kernel"], 15);
  EXPECT_EQ(json["conditions"][2]["hr"][0]["mean"], 0.5);
  EXPECT_EQ(json["conditions"][2]["times_ms"]["map"], 30);
  EXPECT_EQ(json["conditions"][3]["times_ms"]["select"], 4);
  ASSERT_EQ(json["differences"].size(), 4U);
  EXPECT_EQ(json["differences"][0]["of"]["selector"], "proto");
  EXPECT_EQ(json["differences"][0]["minus"]["selector"], "wta");
  EXPECT_EQ(json["differences"][0]["hr"][0]["mean"], 0.5);
  EXPECT_EQ(json["parameters"]["settings"]["levels"], "0..4");
  EXPECT_FALSE(json.contains("shard"));
}

TEST(Report, TextHasTheMeans) {
  const auto plan = sample_plan();
  const std::string text = report_text(plan, summarise(plan, sample_images()));
  EXPECT_THAT(text, HasSubstr("upper bound                               1.000  0.750  0.500\n"));
  EXPECT_THAT(text, HasSubstr("symmetry3d, k = 10, wta                   0.500  0.250  0.333\n"));
}

TEST(Report, TextSaysWhatThePointsLieOn) {
  const auto plan = sample_plan();
  const std::string text = report_text(plan, summarise(plan, images_with_void()));
  EXPECT_THAT(text, HasSubstr("  void-neutral                            1.000  0.500  0.500\n"));
  EXPECT_THAT(text,
              HasSubstr("Share of 3 points on                        new   same   none   void missing\n"));
  EXPECT_THAT(text,
              HasSubstr("symmetry3d, k = 10, proto                 0.333  0.000  0.167  0.167  0.333\n"));
  EXPECT_THAT(text, HasSubstr("symmetry3d, cross-validated"));
  EXPECT_THAT(report_text(plan, summarise(plan, sample_images())), Not(HasSubstr("void")));
}

TEST(Report, PageShowsTableExamplesAndWhatIsLeftOut) {
  EvalPlan plan = sample_plan();
  plan.dataset = "a<b>&c";
  const auto images = sample_images();
  const auto examples = choose_examples(plan, images);
  const std::string page = page_html(plan, summarise(plan, images), {"<svg>FIGURE</svg>", ""}, examples);
  EXPECT_THAT(page, HasSubstr("<svg>FIGURE</svg>"));
  EXPECT_THAT(page, HasSubstr("a&lt;b&gt;&amp;c"));
  EXPECT_THAT(page, HasSubstr("symmetry3d, k = 15, wta"));
  EXPECT_THAT(page, HasSubstr("examples/symmetry3d_000000.jpg"));
  EXPECT_THAT(page, HasSubstr("frame 2 (a,&quot;b&quot;)"));
  EXPECT_THAT(page, HasSubstr("frame 1 (0001): 0001_label.png: 80x80"));
  EXPECT_THAT(page, HasSubstr("What the points lie on"));
  EXPECT_THAT(page, Not(HasSubstr("void")));
  const auto with_void = images_with_void();
  EXPECT_THAT(page_html(plan, summarise(plan, with_void), {}, {}),
              HasSubstr("<td>33<small>0 / 17 / 17, missing 33</small></td>"));
  EXPECT_THAT(page_html(plan, summarise(plan, {images[0]}), {}, {}), Not(HasSubstr("Left out")));
}

}  // namespace
}  // namespace saccade
