// The pyramid of each instruction set against the reference, bit by bit.

#include <cmath>

#include <gtest/gtest.h>

#include "saliency/reference.hpp"
#include "saliency/simd/simd_stages.hpp"
#include "shapes.hpp"

namespace saccade::test {
namespace {

// The depth of level 1 as the stages compute it, in bands of `rows`.
cv::Mat1f halved(const cv::Mat1f& depth, const std::string& simd, int rows) {
  const SimdStages& stages = choose_simd_stages(simd);
  LevelPlanes full(depth.size(), 7), half(level_size(depth.size(), 1), 7);
  RowScratch scratch(depth.cols);
  stages.load_rows(depth, full, 0, depth.rows);
  for (int r = 0; r < half.height(); r += rows)
    stages.halve_rows(full, half, r, std::min(r + rows, half.height()), scratch);
  cv::Mat1f result(half.height(), half.width());
  for (int r = 0; r < result.rows; ++r) std::copy_n(half.row(LevelPlanes::kDepth, r), result.cols, result[r]);
  return result;
}

void expect_same_pyramid(const cv::Mat1f& depth) {
  const cv::Mat1d expected = reference::halve(to_double(depth));
  for (const std::string& simd : runnable_simd())
    for (const int rows : {1, 5, 1000}) {
      const cv::Mat1f actual = halved(depth, simd, rows);
      ASSERT_EQ(actual.size(), expected.size());
      for (int r = 0; r < actual.rows; ++r)
        for (int c = 0; c < actual.cols; ++c)
          ASSERT_EQ(static_cast<double>(actual(r, c)), expected(r, c)) << simd << " at " << r << ", " << c;
    }
}

TEST(Pyramid, IsThatOfTheReferenceToTheBit) {
  for (const cv::Size size :
       {cv::Size(64, 48), cv::Size(61, 47), cv::Size(15, 15), cv::Size(16, 19), cv::Size(131, 18)}) {
    expect_same_pyramid(ball_scene(size, 41));
    expect_same_pyramid(ball_scene(size, 42, 0.2f));
  }
}

TEST(Pyramid, IsExactWhereRoundingIsATie) {
  // Neighbours an eighth apart: weighted means fall on sixteenths.
  cv::Mat1f depth(40, 40);
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c)
      depth(r, c) = 1000.0f + 0.125f * static_cast<float>((r * 7 + c * 3) % 2 + (c / 2) % 2);
  expect_same_pyramid(depth);
}

TEST(Pyramid, IsExactAtTheEndsOfTheRange) {
  cv::Mat1f depth = ball_scene({50, 40}, 43);
  for (int i = 0; i < 40; ++i) {
    depth(i, i) = 1;
    depth(i, 49 - i) = 65535;
  }
  expect_same_pyramid(depth);
}

TEST(Pyramid, ReportsTheRangeOfDepths) {
  cv::Mat1f depth = ball_scene({50, 40}, 44);
  depth(7, 49) = 4321;
  for (const std::string& simd : runnable_simd()) {
    LevelPlanes level(depth.size(), 7);
    const SimdStages& stages = choose_simd_stages(simd);
    EXPECT_EQ(stages.load_rows(depth, level, 0, 20).largest_mm, 4321);
    EXPECT_LT(stages.load_rows(depth, level, 20, 40).largest_mm, 4321);
    EXPECT_TRUE(stages.load_rows(depth, level, 0, 40).multiples_of_eighths);
    cv::Mat1f other = depth.clone();
    other(39, 49) = 1000.2f;
    EXPECT_TRUE(stages.load_rows(other, level, 0, 39).multiples_of_eighths);
    EXPECT_FALSE(stages.load_rows(other, level, 39, 40).multiples_of_eighths);
  }
}

TEST(DepthPacking, ItsSumsStayExact) {
  for (const bool eighths : {true, false})
    for (const int rows : {3, 15, 31, 127})
      for (const float largest : {1.0f, 1900.0f, 4000.3f, 8191.0f, 8192.0f, 32900.0f, 38000.0f, 65535.0f}) {
        const DepthPacking packing = DepthPacking::for_depths(largest, eighths, rows);
        const double points = packing.columns * rows, units = std::ceil(largest * packing.units_per_mm);
        EXPECT_LE(units, DepthPacking::kMostUnits) << largest;
        EXPECT_GE(packing.columns, 1);
        EXPECT_LE(packing.columns, rows);
        EXPECT_LT(points * units, std::exp2(packing.depth_bits)) << largest;
        EXPECT_LT(points * std::exp2(packing.depth_bits) + points * units, std::exp2(32)) << largest;
        if (largest < 33000) {
          EXPECT_GE(packing.units_per_mm, 8) << largest << ' ' << rows;
        }
      }
}

TEST(DepthPacking, HoldsEntireWindowsOfSensors) {
  EXPECT_EQ(DepthPacking::for_depths(8000, true, 15).columns, 15);
}

}  // namespace
}  // namespace saccade::test
