#include "eval/sample.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"
#include "scene/random.hpp"

namespace saccade {
namespace {

std::vector<double> row_of(std::uint64_t i) {
  const double a = scene::uniform(scene::mix(7, i)), b = scene::uniform(scene::mix(8, i));
  return {a, a * a, b > 0.9 ? 1.0 : 0.0};
}

// Up to kMostResampled rows the interval is that of the bootstrap, beyond that of the normal distribution,
// and they agree where one takes over from the other.
TEST(Sample, BothIntervalsAgreeWhereTheyMeet) {
  Sample sample;
  for (std::uint64_t i = 0; i < kMostResampled; ++i) sample.add(row_of(i));
  ASSERT_TRUE(sample.is_kept());
  const Curve kept = curve_of(sample), normal = curve_of(sample.all());
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_EQ(kept.mean[n], normal.mean[n]);
    const double half = (normal.interval[n].high - normal.interval[n].low) / 2;
    EXPECT_NEAR(kept.interval[n].low, normal.interval[n].low, 0.08 * half);
    EXPECT_NEAR(kept.interval[n].high, normal.interval[n].high, 0.08 * half);
  }
  sample.add(row_of(kMostResampled));
  EXPECT_FALSE(sample.is_kept());
  EXPECT_TRUE(sample.rows().empty());
  EXPECT_EQ(curve_of(sample).interval[0].low, sample.all().normal_95()[0].low);
}

TEST(Sample, HalvesAreTheEvenAndTheOddRows) {
  Sample sample;
  for (const double value : {1.0, 10.0, 3.0}) sample.add({value});
  EXPECT_EQ(sample.halves()[0].mean()[0], 2);
  EXPECT_EQ(sample.halves()[1].mean()[0], 10);
  const Moments both = sample.halves()[0] + sample.halves()[1];
  EXPECT_EQ(both.rows, 3U);
  EXPECT_DOUBLE_EQ(both.mean()[0], sample.all().mean()[0]);
  EXPECT_DOUBLE_EQ(both.normal_95()[0].high, sample.all().normal_95()[0].high);
}

// The sample's images again and again: the same means, and intervals that shrink with the root of the number.
TEST(Statistics, OfMoreImagesThanAreKept) {
  const EvalPlan plan = sample_plan();
  const auto images = sample_images();
  const auto repeated = [&](std::size_t times) {
    StatisticsBuilder builder(plan);
    for (std::size_t i = 0; i < times; ++i)
      for (const ImageResult& image : images) builder.add(image);
    return builder.result();
  };
  const std::size_t times = kMostResampled;  // two images of three are part of the evaluation
  const Statistics few = repeated(kMostResampled / 2), many = repeated(times);
  EXPECT_EQ(many.images, 2 * times);
  EXPECT_EQ(many.images_left_out, times);
  EXPECT_EQ(many.left_out.size(), kMostNamed);
  const auto expect_alike = [](const Curve& a, const Curve& b) {
    for (std::size_t n = 0; n < a.mean.size(); ++n) {
      EXPECT_NEAR(a.mean[n], b.mean[n], 1e-12);
      const double ratio = (a.interval[n].high - a.interval[n].low) -
                           std::sqrt(2.0) * (b.interval[n].high - b.interval[n].low);
      EXPECT_NEAR(ratio, 0, 0.08 * (a.interval[n].high - a.interval[n].low) + 1e-6);
    }
  };
  expect_alike(few.bound, many.bound);
  for (std::size_t i = 0; i < 4; ++i) expect_alike(few.conditions[i], many.conditions[i]);
  ASSERT_EQ(few.differences.size(), many.differences.size());
  for (std::size_t i = 0; i < few.differences.size(); ++i)
    expect_alike({few.differences[i].mean, few.differences[i].interval},
                 {many.differences[i].mean, many.differences[i].interval});
  EXPECT_EQ(few.cross_validations[0].used, many.cross_validations[0].used);
  expect_alike(few.cross_validations[0].curve, many.cross_validations[0].curve);
}

}  // namespace
}  // namespace saccade
