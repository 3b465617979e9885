#include "eval/contact_sheet.hpp"

#include <gtest/gtest.h>

#include "samples.hpp"

namespace saccade {
namespace {

// `count` images of which image i finds its one object with point `ranks[i]`, counted from 1; 0 = never.
std::vector<ImageResult> images_of(const std::vector<int>& ranks) {
  std::vector<ImageResult> images;
  for (const int rank : ranks) {
    ImageResult image{.frame = static_cast<std::int64_t>(images.size()), .left_out = {}, .objects = 1};
    image.conditions.resize(4);
    for (int n = 1; n <= 3; ++n) image.conditions[2].points.push_back({0, 0, n == rank ? 1 : 0});
    images.push_back(image);
  }
  return images;
}

TEST(ContactSheet, ChoosesBestAndWorstOfTheBestCondition) {
  auto images = images_of({1, 2, 3, 0, 1, 2, 3, 0, 1, 1, 2});
  images[9].left_out = "bad";
  images[10].objects = 0;
  const auto examples = choose_examples(sample_plan(), images);
  std::vector<std::int64_t> frames;
  for (const Example& example : examples) {
    EXPECT_EQ(example.condition, 2U) << "the only one that finds anything";
    EXPECT_EQ(example.best, frames.size() < 4);
    frames.push_back(example.frame);
  }
  EXPECT_EQ(frames, (std::vector<std::int64_t>{0, 4, 8, 1, 2, 6, 3, 7}));
  EXPECT_DOUBLE_EQ(examples[0].share, 1);
  EXPECT_DOUBLE_EQ(examples[3].share, 2.0 / 3);
  EXPECT_EQ(examples[3].file, "examples/symmetry3d_000001.jpg");
}

TEST(ContactSheet, FewImagesAreShownOnce) {
  EXPECT_EQ(choose_examples(sample_plan(), images_of({1})).size(), 1U);
  const auto three = choose_examples(sample_plan(), images_of({1, 0, 2}));
  ASSERT_EQ(three.size(), 3U);
  EXPECT_TRUE(three[1].best);
  EXPECT_FALSE(three[2].best);
}

TEST(ContactSheet, PictureShowsObjectsHitAndMissed) {
  Frame frame;
  frame.depth_mm = cv::Mat1f(240, 640, 1000.0F);
  frame.colour = cv::Mat3b(240, 640, cv::Vec3b(128, 128, 128));
  frame.truth.labels = cv::Mat1w(240, 640, std::uint16_t{0});
  frame.truth.labels(cv::Rect(100, 60, 120, 120)).setTo(1);
  frame.truth.labels(cv::Rect(400, 60, 120, 120)).setTo(2);
  SaliencyMaps maps;
  maps.master = cv::Mat1f(240, 640, 0.0F);
  const cv::Mat3b picture = draw_example(frame, maps, {{120, 160, 1}});
  ASSERT_EQ(picture.size(), cv::Size(480, 180));
  const auto count = [&](cv::Rect part, auto is) {
    int pixels = 0;
    for (const cv::Vec3b& p : cv::Mat3b(picture(part))) pixels += is(p);
    return pixels;
  };
  const auto red = [](const cv::Vec3b& p) { return p[2] > 180 && p[0] < 130; };
  const auto white = [](const cv::Vec3b& p) { return p[0] > 180 && p[2] > 180; };
  EXPECT_EQ(count({0, 0, 240, 180}, red), 0);
  EXPECT_GT(count({70, 40, 100, 100}, white), 100);
  EXPECT_GT(count({290, 40, 110, 100}, red), 100);
  EXPECT_EQ(frame.colour(120, 160), cv::Vec3b(128, 128, 128)) << "the frame is not drawn on";
}

}  // namespace
}  // namespace saccade
