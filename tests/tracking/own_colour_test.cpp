// The colour that most of a surface has.
#include "tracking/own_colour.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

std::vector<cv::Vec2f> some(int wood, int green, int dark) {
  std::vector<cv::Vec2f> colours(at(wood), cv::Vec2f(0.2F, 0.45F));
  colours.insert(colours.end(), at(green), cv::Vec2f(0.25F, 0.2F));
  colours.insert(colours.end(), at(dark), cv::Vec2f(-1, -1));
  return colours;
}

TEST(OwnColour, IsTheMostFrequentOne) {
  OwnColour own;
  const auto found = own.find(some(60, 40, 0), 0.5);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[0], 0.2, 1e-5);
  EXPECT_NEAR((*found)[1], 0.45, 1e-5) << "what else is there does not change it";
}

TEST(OwnColour, IsThatOfEnoughCells) {
  OwnColour own;
  EXPECT_TRUE(own.find(some(60, 40, 0), 0.6));
  EXPECT_FALSE(own.find(some(59, 41, 0), 0.6));
  EXPECT_FALSE(own.find(some(59, 0, 41), 0.6)) << "dark cells count, and have none";
  EXPECT_FALSE(own.find(some(0, 0, 10), 0.1));
  EXPECT_FALSE(own.find({}, 0.1));
}

TEST(OwnColour, IsTheMeanOfWhatIsNear) {
  std::vector<cv::Vec2f> colours = some(50, 0, 0);
  for (std::size_t k = 0; k < colours.size(); k += 2) colours[k][0] += 0.01F;
  const auto found = OwnColour().find(colours, 0.9);
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[0], 0.205, 1e-5);
}

TEST(OwnColour, DistanceIsThatOfAllThreeParts) {
  EXPECT_FLOAT_EQ(distance({0.3F, 0.3F}, {0.3F, 0.3F}), 0);
  EXPECT_NEAR(distance({0.4F, 0.3F}, {0.3F, 0.3F}), std::sqrt(0.02), 1e-6) << "0.1 of blue, -0.1 of green";
}

TEST(OwnColour, ChromaticityOfACell) {
  cv::Mat1f depth(8, 8, 1000.0F);
  SurfaceGrid grid;
  grid.build(depth, Intrinsics::guess_for(depth.size()));
  cv::Mat3b colour(8, 8, kBlack);
  colour({4, 0, 4, 4}) = cv::Vec3b(30, 60, 60);
  EXPECT_EQ(chromaticity(grid, colour, 1), cv::Vec2f(0.2F, 0.4F));
  EXPECT_LT(chromaticity(grid, colour, 0)[0], 0) << "too dark";
}

}  // namespace
}  // namespace saccade
