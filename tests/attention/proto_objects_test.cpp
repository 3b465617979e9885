#include "attention/proto_objects.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "instruction_sets.hpp"
#include "table_scene.hpp"

namespace saccade {
namespace {

// The pixels of the cells as their documentation says it, one by one in double.
ProtoObject slow_paint(const cv::Mat1f& depth, const Intrinsics& camera, const SurfaceGrid& grid,
                       const std::vector<int>& cells, cv::Mat1w& masks, int rank) {
  ProtoObject object;
  cv::Point3d sum, low(1e9, 1e9, 1e9), high(-1e9, -1e9, -1e9);
  for (int r = 0; r < depth.rows; ++r)
    for (int c = 0; c < depth.cols; ++c) {
      const int cell = r / kCell * grid.cols() + c / kCell;
      if (std::find(cells.begin(), cells.end(), cell) == cells.end()) continue;
      const float z = depth(r, c), z0 = grid.depth_mm()[static_cast<std::size_t>(cell)];
      if (!(z > 0) || std::abs(z - z0) > SurfaceGrid::kSameSurface * z0) continue;
      masks(r, c) = static_cast<ushort>(rank);
      ++object.pixels;
      const cv::Point3d p = camera.point_mm(r, c, static_cast<double>(z));
      sum += p;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  object.centroid_mm = sum / object.pixels;
  object.extent_mm = high - low;
  return object;
}

// 161 x 122: the last cells hold 1 x 2 pixels.
TEST(ProtoObjects, PaintsAndMeasuresAsTheSlowForm) {
  TableScene scene = look_at_table({box(0, 100, 150, 120, 130), ball(-250, 0, 70)}, {161, 122});
  std::mt19937 random(11);
  for (float& z : scene.depth_mm)
    z = random() % 8 == 0 ? 0.0F : z + static_cast<float>(random() % 1000) * 0.05F - 25.0F;
  scene.depth_mm(cv::Rect(60, 40, 8, 8)) = 0.0F;
  SurfaceGrid grid;
  grid.build(scene.depth_mm, scene.camera);
  SurfaceSegments segments;
  segments.grow(grid);
  ProtoObjects objects;
  objects.begin(grid, segments, scene.depth_mm, scene.camera);
  std::vector<int> cells(grid.size());
  std::iota(cells.begin(), cells.end(), 0);
  ASSERT_GT(grid.depth_mm().back(), 0);                      // of 1 x 2 pixels
  ASSERT_EQ(*std::ranges::min_element(grid.depth_mm()), 0);  // and some have none
  cv::Mat1w slow_masks(scene.depth_mm.size(), 7);
  const ProtoObject slow = slow_paint(scene.depth_mm, scene.camera, grid, cells, slow_masks, 3);
  std::vector<ProtoObject> found;
  with_each_instruction_set([&] {
    cv::Mat1w masks(scene.depth_mm.size(), 7);
    const ProtoObject object = found.emplace_back(objects.paint(cells, masks, 3));
    EXPECT_EQ(cv::countNonZero(masks != slow_masks), 0);
    EXPECT_EQ(object.pixels, slow.pixels);
    EXPECT_GT(cv::countNonZero(masks == 7), 1000);
    EXPECT_LT(cv::norm(object.centroid_mm - slow.centroid_mm), 1e-2);
    EXPECT_LT(cv::norm(object.extent_mm - slow.extent_mm), 1e-2);
    EXPECT_EQ(object.centroid_mm, found.front().centroid_mm);  // to the bit
    EXPECT_EQ(object.extent_mm, found.front().extent_mm);
  });
}

}  // namespace
}  // namespace saccade
