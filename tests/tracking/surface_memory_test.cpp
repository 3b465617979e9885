#include "tracking/surface_memory.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "fixtures.hpp"

namespace saccade {
namespace {

constexpr double kFrame_s = 1.0 / 30;

SurfaceGrid grid_of(const cv::Mat1f& depth_mm) {
  SurfaceGrid grid;
  grid.build(depth_mm, kCamera);
  return grid;
}

cv::Mat1f wall(float depth_mm) { return cv::Mat1f(120, 160, depth_mm); }

cv::Affine3d shifted(double x_mm) { return cv::Affine3d(cv::Matx33d::eye(), cv::Vec3d(x_mm, 0, 0)); }

class SurfaceMemoryTest : public ::testing::Test {
 protected:
  void see(const cv::Mat1f& depth_mm, const std::vector<float>& values,
           const cv::Affine3d& to_previous = kStill) {
    grid_ = grid_of(depth_mm);
    memory_.carry(grid_, to_previous);
    memory_.learn(values, kFrame_s);
  }
  static std::vector<float> constant(float value) { return std::vector<float>(30 * 40, value); }
  std::size_t cell(int row, int col) const { return static_cast<std::size_t>(row * grid_.cols() + col); }

  SurfaceMemory memory_;
  SurfaceGrid grid_;
};

TEST_F(SurfaceMemoryTest, TheFirstMeanIsTheValue) {
  std::vector<float> values = constant(0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1F * static_cast<float>(i);
  see(wall(1000), values);
  EXPECT_EQ(memory_.mean(), values);
  EXPECT_EQ(memory_.before()[cell(10, 10)], SurfaceMemory::Before::unknown);
}

// Equal weights at first, then weights that decay with time.
TEST_F(SurfaceMemoryTest, TheMeanIsThatOfTheLastHalfSecond) {
  double expected = 0;
  for (int k = 0; k < 60; ++k) {
    const double value = k % 7;
    see(wall(1000), constant(static_cast<float>(value)));
    const double share = std::max(1.0 / (k + 1), 1 - std::exp(-kFrame_s / SurfaceMemory::kMean_s));
    expected += share * (value - expected);
    EXPECT_NEAR(memory_.mean()[cell(10, 20)], expected, 1e-4) << k;
  }
  EXPECT_EQ(memory_.age()[cell(10, 20)], 59);
}

TEST_F(SurfaceMemoryTest, MovesWithTheSurfaceWhenTheCameraMoves) {
  std::vector<float> values = constant(0);
  see(wall(1000), values);
  values[cell(10, 20)] = 8;
  see(wall(1000), values);
  memory_.owner()[cell(10, 20)] = 5;
  // 20 mm of 1 m are 200 * 0.02 = 4 px: one cell. What was in column 20 is now in column 19.
  see(wall(1000), constant(0), shifted(20));
  EXPECT_EQ(memory_.owner()[cell(10, 19)], 5);
  EXPECT_EQ(memory_.owner()[cell(10, 20)], SurfaceMemory::kNobody);
  EXPECT_NEAR(memory_.mean()[cell(10, 19)], 8.0 / 3, 0.01) << "of 0, 8 and 0";
  // Half a cell more: the mean is shared, the owner goes to the nearest.
  see(wall(1000), constant(0), shifted(8));
  EXPECT_GT(memory_.mean()[cell(10, 19)], memory_.mean()[cell(10, 18)]);
  EXPECT_GT(memory_.mean()[cell(10, 18)], 0);
  EXPECT_EQ(memory_.owner()[cell(10, 19)], 5);
}

TEST_F(SurfaceMemoryTest, BeginsAgainWhereAnotherSurfaceIsSeen) {
  see(wall(1000), constant(6));
  for (int& owner : memory_.owner()) owner = 2;
  cv::Mat1f with_box = wall(1000);
  with_box(cv::Rect(40, 40, 40, 40)) = 900.0F;
  see(with_box, constant(0));
  EXPECT_EQ(memory_.mean()[cell(15, 15)], 0);
  EXPECT_EQ(memory_.owner()[cell(15, 15)], SurfaceMemory::kNobody);
  EXPECT_EQ(memory_.before()[cell(15, 15)], SurfaceMemory::Before::behind)
      << "the box has come before the wall";
  EXPECT_EQ(memory_.mean()[cell(5, 5)], 3);
  EXPECT_EQ(memory_.owner()[cell(5, 5)], 2);
  EXPECT_EQ(memory_.before()[cell(5, 5)], SurfaceMemory::Before::same);
  see(wall(1000), constant(0));
  EXPECT_EQ(memory_.before()[cell(15, 15)], SurfaceMemory::Before::in_front) << "the box was before the wall";
}

TEST_F(SurfaceMemoryTest, KnowsNothingWithoutReadingsAndBeyondTheImage) {
  cv::Mat1f gap = wall(1000);
  gap(cv::Rect(40, 40, 40, 40)) = 0.0F;
  see(gap, constant(4));
  see(wall(1000), constant(0), shifted(100));
  EXPECT_EQ(memory_.before()[cell(12, 12)], SurfaceMemory::Before::unknown);
  EXPECT_EQ(memory_.before()[cell(12, 38)], SurfaceMemory::Before::unknown) << "was out of view";
  EXPECT_EQ(memory_.mean()[cell(12, 38)], 0);
  EXPECT_EQ(memory_.before()[cell(3, 3)], SurfaceMemory::Before::same);
}

TEST_F(SurfaceMemoryTest, MeansAloneCanBeForgotten) {
  for (int k = 0; k < 5; ++k) see(wall(1000), constant(3));
  memory_.owner()[cell(10, 20)] = 7;
  memory_.forget_means();
  see(wall(1000), constant(8));
  EXPECT_EQ(memory_.mean()[cell(10, 20)], 8);
  EXPECT_EQ(memory_.age()[cell(10, 20)], 0);
  EXPECT_EQ(memory_.owner()[cell(10, 20)], 7);
  EXPECT_EQ(memory_.before()[cell(10, 20)], SurfaceMemory::Before::same);
}

TEST_F(SurfaceMemoryTest, ClearForgets) {
  see(wall(1000), constant(4));
  memory_.clear();
  see(wall(1000), constant(0));
  EXPECT_EQ(memory_.mean()[cell(3, 3)], 0);
  EXPECT_EQ(memory_.before()[cell(3, 3)], SurfaceMemory::Before::unknown);
}

}  // namespace
}  // namespace saccade
