#include "output/colour_map.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

// Approximate perceived lightness.
double luma(const cv::Vec3b& bgr) { return 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2]; }

TEST(Palette, NamesGoBothWays) {
  for (const Palette palette : kPalettes) EXPECT_EQ(palette_named(to_string(palette)), palette);
  EXPECT_FALSE(palette_named("jet"));
}

TEST(Palette, ViridisInfernoAndGreyGrowInLightness) {
  for (const Palette palette : {Palette::viridis, Palette::inferno, Palette::grey}) {
    const PaletteColours& colours = colours_of(palette);
    for (std::size_t i = 8; i < colours.size(); ++i)
      EXPECT_GT(luma(colours[i]), luma(colours[i - 8])) << to_string(palette) << " at " << i;
  }
}

TEST(Palette, TurboGoesFromBlueOverGreenToRed) {
  const PaletteColours& colours = colours_of(Palette::turbo);
  EXPECT_GT(colours[30][0], colours[30][2]);
  EXPECT_GT(colours[128][1], colours[128][0]);
  EXPECT_GT(colours[230][2], colours[230][0]);
}

TEST(PercentileRange, LeavesOutTheEndsAndValuesNotAboveZero) {
  cv::Mat1f image(100, 700, 0.0F);
  for (int r = 0; r < 100; ++r) image.row(r) = static_cast<float>(r);
  image(50, 1) = -5;
  EXPECT_EQ(percentile_range(image, 1), (ValueRange{1, 99}));
  EXPECT_EQ(percentile_range(image, 10), (ValueRange{10, 90}));
  EXPECT_EQ(percentile_range(image, 0), (ValueRange{1, 99}));
  EXPECT_FALSE(percentile_range(cv::Mat1f(8, 8, 0.0F), 1));
}

TEST(ColourMap, GreyIsTheRootOfTheShareOfTheLargestValue) {
  const cv::Mat1b grey = to_grey((cv::Mat1f(1, 3) << 0, 0.5, 2));
  EXPECT_EQ(grey(0), 0);
  EXPECT_EQ(grey(1), 128);
  EXPECT_EQ(grey(2), 255);
  EXPECT_EQ(cv::countNonZero(to_grey(cv::Mat1f(4, 4, 0.0F))), 0);
}

TEST(ColourMap, NearDepthIsBrighterAndNoReadingIsBlack) {
  cv::Mat1f depth(20, 20, 1000.0F);
  depth.rowRange(10, 20) = 2000.0F;
  depth(0, 0) = 0;
  const cv::Mat3b picture = depth_picture(depth);
  EXPECT_GT(picture(5, 5)[0], picture(15, 5)[0]);
  EXPECT_GT(picture(15, 5)[0], 0);
  EXPECT_EQ(picture(0, 0), cv::Vec3b());
  EXPECT_EQ(cv::norm(depth_picture(cv::Mat1f(8, 8, 0.0F))), 0);
}

TEST(ColourMap, AFixedRangeDoesNotFollowTheImage) {
  cv::Mat1f depth(20, 20, 1000.0F);
  const DepthStyle style{.palette = Palette::viridis, .range_mm = ValueRange{500, 2500}};
  const cv::Vec3b before = depth_picture(depth, style)(5, 5);
  depth.rowRange(10, 20) = 4000.0F;
  depth(0, 0) = 0;
  const cv::Mat3b after = depth_picture(depth, style);
  EXPECT_EQ(after(5, 5), before);
  EXPECT_EQ(before, colours_of(Palette::viridis)[188]) << "45 + 190 * (2500 - 1000) / 2000, rounded to even";
  EXPECT_EQ(after(0, 0), cv::Vec3b());
  EXPECT_EQ(depth_colour(Palette::viridis, (1000.0 - 500) / 2000), before) << "for the legend";
}

}  // namespace
}  // namespace saccade
