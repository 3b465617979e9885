#include "eval/hit_ratio.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/random.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(HitRatioOfImage, CountsDifferentObjectsOnly) {
  const std::vector<int> hits = {7, 7, 0, 3, 7, 9};
  EXPECT_THAT(objects_found(hits, 6), ElementsAre(1, 1, 1, 2, 2, 3));
  EXPECT_THAT(hit_ratio(hits, 6), ElementsAre(1, 0.5, 1 / 3.0, 0.5, 0.4, 0.5));
}

TEST(HitRatioOfImage, MissingPointsAreMisses) {
  EXPECT_THAT(hit_ratio(std::vector<int>{2}, 4), ElementsAre(1, 0.5, 1 / 3.0, 0.25));
  EXPECT_THAT(hit_ratio({}, 2), ElementsAre(0, 0));
  EXPECT_THAT(objects_found(std::vector<int>{1, 2, 3}, 2), ElementsAre(1, 2)) << "more than were asked for";
}

TEST(HitRatioOfImage, PointsOnVoidMakeRoomForTheNext) {
  const std::vector<int> hits = {kVoid, 7, kVoid, 0, 7, 3};
  EXPECT_THAT(hit_ratio(hits, 4), ElementsAre(0, 0.5, 1 / 3.0, 0.25)) << "a miss without the class image";
  EXPECT_THAT(without_void(hits), ElementsAre(7, 0, 7, 3));
  EXPECT_THAT(hit_ratio(without_void(hits), 4), ElementsAre(1, 0.5, 1 / 3.0, 0.5));
  EXPECT_THAT(hit_ratio(without_void(std::vector<int>{kVoid, kVoid}), 2), ElementsAre(0, 0));
}

TEST(HitRatioOfImage, KindsOfPoints) {
  const std::vector<int> hits = {kVoid, 7, 0, 7, 3};
  EXPECT_THAT(point_kinds(hits, 6),
              ElementsAre(PointKinds{0, 0, 0, 1, 0}, PointKinds{1, 0, 0, 1, 0}, PointKinds{1, 0, 1, 1, 0},
                          PointKinds{1, 1, 1, 1, 0}, PointKinds{2, 1, 1, 1, 0}, PointKinds{2, 1, 1, 1, 1}));
}

// The definitions, counted from the beginning for each n.
TEST(HitRatioOfImage, AgreesWithASlowReference) {
  for (std::uint64_t sample = 0; sample < 200; ++sample) {
    std::vector<int> hits;
    for (std::uint64_t i = 0; i < sample % 15; ++i)
      hits.push_back(static_cast<int>(7 * scene::uniform(scene::mix(sample, i))) - 1);  // kVoid, 0, 1..5
    for (int n = 1; n <= 12; ++n) {
      const auto at = static_cast<std::size_t>(n - 1);
      const std::vector<int> first(hits.begin(),
                                   hits.begin() + std::min<std::ptrdiff_t>(n, std::ssize(hits)));
      const auto count = [&](auto is) {
        return static_cast<int>(std::count_if(first.begin(), first.end(), is));
      };
      std::set<int> objects;
      for (const int label : first)
        if (label != 0 && label != kVoid) objects.insert(label);
      const int found = static_cast<int>(objects.size());
      EXPECT_DOUBLE_EQ(hit_ratio(hits, 12)[at], found / static_cast<double>(n));
      const PointKinds kinds = point_kinds(hits, 12)[at];
      EXPECT_EQ(kinds.new_object, found);
      EXPECT_EQ(kinds.same_object, count([](int label) { return label > 0; }) - found);
      EXPECT_EQ(kinds.structure, count([](int label) { return label == 0; }));
      EXPECT_EQ(kinds.unlabelled, count([](int label) { return label == kVoid; }));
      EXPECT_EQ(kinds.missing, n - static_cast<int>(first.size()));

      // Void-neutral: the first n points that are not on void, however many others lie between them.
      std::set<int> neutral;
      int taken = 0;
      for (std::size_t i = 0; i < hits.size() && taken < n; ++i) {
        if (hits[i] == kVoid) continue;
        ++taken;
        if (hits[i] > 0) neutral.insert(hits[i]);
      }
      EXPECT_DOUBLE_EQ(hit_ratio(without_void(hits), 12)[at],
                       static_cast<double>(neutral.size()) / static_cast<double>(n));
    }
  }
}

TEST(HitRatioOfImage, BoundIsAllObjectsAtOnce) {
  EXPECT_THAT(hit_ratio_bound(2, 4), ElementsAre(1, 1, 2 / 3.0, 0.5));
  EXPECT_THAT(hit_ratio_bound(0, 2), ElementsAre(0, 0));
  const std::vector<int> perfect = {1, 2, 3};
  EXPECT_EQ(hit_ratio(perfect, 8), hit_ratio_bound(3, 8));
}

TEST(HitRatioOfImage, AreasLeaveOutTheGround) {
  const cv::Mat1w labels = (cv::Mat1w(2, 3) << 0, 5, 5, 65535, 0, 5);
  EXPECT_THAT(object_areas(labels), ElementsAre(Pair(5, 3), Pair(65535, 1)));
}

TEST(Baselines, RandomOfHandMadeImage) {
  cv::Mat1w labels(10, 10, std::uint16_t{0});
  labels.rowRange(0, 5).setTo(1);  // a half
  labels.rowRange(5, 6).setTo(2);  // a tenth
  const auto ratio = random_hit_ratio(labels, 2);
  EXPECT_NEAR(ratio[0], 0.6, 1e-12);
  EXPECT_NEAR(ratio[1], (0.75 + 0.19) / 2, 1e-12);
  EXPECT_THAT(random_hit_ratio(cv::Mat1w(4, 4, std::uint16_t{0}), 2), ElementsAre(0, 0));
  EXPECT_THAT(random_hit_ratio(cv::Mat1w(4, 4, std::uint16_t{9}), 2), ElementsAre(1, 0.5));
}

// The mean of many drawn sets of points, drawn with `column` and `row`.
template <typename Draw>
std::vector<double> drawn_hit_ratio(const cv::Mat1w& labels, int points, Draw draw) {
  constexpr int kRepeats = 20000;
  std::vector<double> sum(static_cast<std::size_t>(points));
  std::uint64_t count = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::vector<int> hits;
    while (hits.size() < sum.size()) {
      const cv::Point p = draw(scene::mix(1, count), scene::mix(2, count));
      ++count;
      if (p.inside({0, 0, labels.cols, labels.rows})) hits.push_back(labels(p));
    }
    const auto ratio = hit_ratio(hits, points);
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += ratio[n] / kRepeats;
  }
  return sum;
}

cv::Mat1w three_objects() {
  cv::Mat1w labels(24, 32, std::uint16_t{0});
  labels(cv::Rect(14, 10, 5, 5)).setTo(1);  // in the middle
  labels(cv::Rect(0, 0, 4, 24)).setTo(2);
  labels(cv::Rect(20, 18, 9, 6)).setTo(3);
  return labels;
}

TEST(Baselines, RandomIsTheMeanOfDrawnPoints) {
  const cv::Mat1w labels = three_objects();
  const auto drawn = drawn_hit_ratio(labels, 6, [](std::uint64_t a, std::uint64_t b) {
    return cv::Point(static_cast<int>(scene::uniform(a) * 32), static_cast<int>(scene::uniform(b) * 24));
  });
  const auto expected = random_hit_ratio(labels, 6);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(drawn[n], expected[n], 0.01) << n + 1;
}

TEST(Baselines, CentreIsTheMeanOfDrawnPoints) {
  const cv::Mat1w labels = three_objects();
  const auto drawn = drawn_hit_ratio(labels, 6, [](std::uint64_t a, std::uint64_t b) {
    return cv::Point(static_cast<int>(std::lround(15.5 + 8 * static_cast<double>(scene::gaussian(a)))),
                     static_cast<int>(std::lround(11.5 + 6 * static_cast<double>(scene::gaussian(b)))));
  });
  const auto expected = centre_hit_ratio(labels, 6);
  for (std::size_t n = 0; n < 6; ++n) EXPECT_NEAR(drawn[n], expected[n], 0.012) << n + 1;
}

TEST(Baselines, CentreFindsWhatIsInTheMiddle) {
  cv::Mat1w middle(40, 40, std::uint16_t{0}), corner = middle.clone();
  middle(cv::Rect(15, 15, 10, 10)).setTo(1);
  corner(cv::Rect(0, 0, 10, 10)).setTo(1);
  EXPECT_GT(centre_hit_ratio(middle, 1)[0], random_hit_ratio(middle, 1)[0]);
  EXPECT_LT(centre_hit_ratio(corner, 1)[0], random_hit_ratio(corner, 1)[0]);
}

}  // namespace
}  // namespace saccade
