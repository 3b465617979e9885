#include "models/itti.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "displays.hpp"
#include "models/image.hpp"
#include "models/local_maxima.hpp"

namespace saccade {
namespace {

TEST(PromoteFewPeaks, HandComputed) {
  cv::Mat1f map(9, 9, 0.0F);
  map(2, 2) = 4;
  map(6, 6) = 2;
  promote_few_peaks(map);  // 1 and 0.5, times (1 - 0.5)^2
  EXPECT_FLOAT_EQ(map(2, 2), 0.25F);
  EXPECT_FLOAT_EQ(map(6, 6), 0.125F);
  EXPECT_EQ(map(4, 4), 0);
}

TEST(PromoteFewPeaks, KeepsOnePeakAndErasesMany) {
  cv::Mat1f one(7, 7, 3.0F);
  one(3, 3) = 5;
  promote_few_peaks(one);
  EXPECT_EQ(one(3, 3), 1);
  EXPECT_EQ(one(0, 0), 0);

  cv::Mat1f many(9, 9, 0.0F);
  for (int r = 1; r < 9; r += 3)
    for (int c = 1; c < 9; c += 3) many(r, c) = 2;
  promote_few_peaks(many);
  EXPECT_EQ(cv::norm(many, cv::NORM_INF), 0);
}

TEST(PromoteFewPeaks, CountsAPlateauOnceAndNoNoise) {
  cv::Mat1f map(9, 9, 0.0F);
  map(1, 1) = map(1, 2) = map(2, 1) = map(2, 2) = 10;
  map(6, 6) = 0.9F;  // below a tenth
  promote_few_peaks(map);
  EXPECT_EQ(map(1, 1), 1);

  cv::Mat1f nearly_flat(5, 5, 0.5F);
  nearly_flat(2, 2) = 0.5005F;
  promote_few_peaks(nearly_flat);
  EXPECT_EQ(cv::norm(nearly_flat, cv::NORM_INF), 0);
}

// N(.) as README.md has it, pixel by pixel in double: a peak is no lower than its neighbours, and higher than
// those before it.
cv::Mat1d slow_promote(const cv::Mat1d& map) {
  double low = 0, high = 0;
  cv::minMaxLoc(map, &low, &high);
  cv::Mat1d scaled, promoted;
  map.convertTo(scaled, CV_64F, 1 / (high - low), -low / (high - low));
  double sum = 0;
  int peaks = 0;
  for (int r = 0; r < map.rows; ++r)
    for (int c = 0; c < map.cols; ++c) {
      bool peak = scaled(r, c) >= 0.1;
      for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right) {
          const int i = r + down, j = c + right;
          if (i < 0 || j < 0 || i >= map.rows || j >= map.cols || (down == 0 && right == 0)) continue;
          const bool before = down < 0 || (down == 0 && right < 0);
          peak = peak && (before ? scaled(i, j) < scaled(r, c) : scaled(i, j) <= scaled(r, c));
        }
      if (peak) sum += scaled(r, c), ++peaks;
    }
  const double others = peaks > 1 ? (sum - 1) / (peaks - 1) : 0;
  scaled.convertTo(promoted, CV_64F, (1 - others) * (1 - others));
  return promoted;
}

// Few different values, so that there are plateaus; maps of one row or column, and with a rest in any vector.
TEST(PromoteFewPeaks, IsTheSlowForm) {
  cv::RNG random(8);
  for (const cv::Size size : {cv::Size(1, 9), {9, 1}, {2, 2}, {3, 5}, {33, 20}, {80, 60}})
    for (const int values : {3, 20, 4000}) {
      cv::Mat1f map(size);
      for (float& value : map) value = static_cast<float>(random.uniform(0, values)) / 16;
      map(0, 0) = 0, map(size.height - 1, size.width - 1) = static_cast<float>(values) / 16;
      const cv::Mat1d slow = slow_promote(as_double(map));
      promote_few_peaks(map);
      EXPECT_LT(cv::norm(as_double(map), slow, cv::NORM_INF), 1e-5) << size << ' ' << values;
    }
}

TEST(AttenuateBorder, HandComputed) {
  cv::Mat1f map(21, 30, 1.0F);  // a border of 2
  attenuate_border(map);
  EXPECT_FLOAT_EQ(map(0, 10), 1.0F / 3);
  EXPECT_FLOAT_EQ(map(10, 28), 2.0F / 3);
  EXPECT_FLOAT_EQ(map(1, 0), 2.0F / 9);
  EXPECT_EQ(map(2, 2), 1);
  EXPECT_EQ(map(18, 27), 1);
  EXPECT_FLOAT_EQ(map(20, 29), 1.0F / 9);
}

TEST(UpsampleRows, InterpolatesBetweenTheEvenPixels) {
  const cv::Mat1f coarse = (cv::Mat1f(2, 2) << 0, 4, 8, 12);
  cv::Mat1f fine(4, 4);
  upsample_rows(coarse, 1, fine, false, 0, 4);
  const cv::Mat1f expected = (cv::Mat1f(4, 4) << 0, 2, 4, 4, 4, 6, 8, 8, 8, 10, 12, 12, 8, 10, 12, 12);
  EXPECT_EQ(cv::norm(fine, expected, cv::NORM_INF), 0);
  upsample_rows(coarse, 1, fine, true, 0, 4);
  EXPECT_EQ(cv::norm(fine, 2 * expected, cv::NORM_INF), 0);
  cv::Mat1f odd(7, 5);
  upsample_rows(coarse, 2, odd, false, 0, 7);
  EXPECT_EQ(odd(1, 1), 3);
  EXPECT_EQ(odd(6, 4), 12);
}

class PopOut : public ::testing::TestWithParam<const char*> {};

TEST_P(PopOut, OneBarOfAnotherOrientation) {
  for (const auto& [size, spacing] : {std::pair{cv::Size(640, 480), 80},
                                      {cv::Size(500, 390), 80},
                                      {cv::Size(320, 240), 40},
                                      {cv::Size(256, 256), 42}})
    for (const auto& [angle, odd_angle] : {std::pair{0.0, 90.0}, {90.0, 0.0}, {45.0, 135.0}, {20.0, 110.0}})
      for (const cv::Point odd : {cv::Point(5, 1), cv::Point(2, 3), cv::Point(3, 2)}) {
        BarDisplay display;
        display.size = size;
        display.spacing = spacing;
        display.angle_deg = angle;
        display.odd_angle_deg = odd_angle;
        display.odd_row = odd.y;
        display.odd_col = odd.x;
        EXPECT_LT(display.miss(map_of(GetParam(), frame_of(display.draw()))), spacing / 2)
            << size << " " << angle << " " << odd;
      }
}

INSTANTIATE_TEST_SUITE_P(Itti, PopOut, ::testing::Values("itti", "itti_orientation"));

TEST(Itti, OneBarOfAnotherColourPopsOut) {
  const cv::Scalar red(40, 40, 220), green(40, 220, 40), blue(230, 60, 60), yellow(40, 200, 200);
  for (const auto& [colour, odd] : {std::pair{green, red}, {red, green}, {yellow, blue}, {blue, yellow}})
    for (const cv::Point at : {cv::Point(5, 1), cv::Point(2, 3)}) {
      BarDisplay display;
      display.colour = colour;
      display.odd_colour = odd;
      display.odd_row = at.y;
      display.odd_col = at.x;
      EXPECT_LT(display.miss(map_of("itti", frame_of(display.draw()))), 40) << colour << odd << at;
    }
}

TEST(Itti, SmallImagesUseFinerLevels) {
  cv::Mat3b spot(24, 32, cv::Vec3b(50, 50, 50));
  cv::circle(spot, {22, 8}, 2, {255, 255, 255}, cv::FILLED);
  const cv::Point at = maximum_of(map_of("itti", frame_of(spot)));
  EXPECT_LE(std::hypot(at.x - 22, at.y - 8), 4) << at;
}

TEST(IttiOrientation, IgnoresColour) {
  cv::Mat3b image(240, 320, cv::Vec3b(0, 0, 254));  // equal sums of channels, so equal intensity
  image(cv::Rect(100, 100, 30, 30)) = cv::Vec3b(0, 254, 0);
  EXPECT_EQ(cv::norm(map_of("itti_orientation", frame_of(image)), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(map_of("itti", frame_of(image)), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace saccade
