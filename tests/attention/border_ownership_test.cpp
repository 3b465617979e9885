#include "attention/border_ownership.hpp"

#include <random>

#include <gtest/gtest.h>

#include "table_scene.hpp"

namespace saccade {
namespace {

struct Scene {
  SurfaceGrid grid;
  SurfaceSegments segments;
  BorderOwnership borders;

  Scene(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
    grid.build(depth_mm, camera);
    segments.grow(grid);
    borders.measure(grid, segments);
  }
  int segment_at(int row_px, int col_px) const {
    return segments.of_cell()[static_cast<std::size_t>(row_px / 4 * grid.cols() + col_px / 4)];
  }
};

// From each cell of the segment in four directions to the next cell with depth.
double slow_front_share(const Scene& scene, int segment) {
  const SurfaceGrid& grid = scene.grid;
  const auto index = [&](int r, int c) { return static_cast<std::size_t>(r * grid.cols() + c); };
  int owned = 0, all = 0;
  for (int r = 0; r < grid.rows(); ++r)
    for (int c = 0; c < grid.cols(); ++c) {
      if (scene.segments.of_cell()[index(r, c)] != segment) continue;
      const struct {
        int down, right, link;
      } directions[] = {{0, 1, SurfaceGrid::kRight},
                        {1, 0, SurfaceGrid::kDown},
                        {0, -1, SurfaceGrid::kLeft},
                        {-1, 0, SurfaceGrid::kUp}};
      for (const auto& d : directions) {
        int steps = 1;
        const auto inside = [&] {
          const int y = r + steps * d.down, x = c + steps * d.right;
          return y >= 0 && x >= 0 && y < grid.rows() && x < grid.cols();
        };
        while (inside() && grid.depth_mm()[index(r + steps * d.down, c + steps * d.right)] == 0) ++steps;
        if (!inside()) {
          ++all;
          continue;
        }
        const std::size_t next = index(r + steps * d.down, c + steps * d.right);
        if (scene.segments.of_cell()[next] == segment) continue;
        ++all;
        const double z = static_cast<double>(grid.depth_mm()[index(r, c)]),
                     behind = static_cast<double>(grid.depth_mm()[next]);
        if (steps == 1 && (grid.links()[index(r, c)] & d.link)) continue;
        if (steps <= 11 && behind - z > 0.012 * z * std::max(1.0, z / 1000)) ++owned;
      }
    }
  return all > 0 ? static_cast<double>(owned) / all : 0;
}

void expect_as_slow(const Scene& scene) {
  for (int segment = 0; segment < scene.segments.count(); ++segment)
    EXPECT_NEAR(scene.borders.front_share(segment), slow_front_share(scene, segment), 1e-6) << segment;
}

TEST(BorderOwnership, IsAsTheSlowForm) {
  TableScene table = look_at_table({box(0, 100, 150, 120, 130), ball(-250, 0, 70)}, {323, 242});
  expect_as_slow(Scene(table.depth_mm, table.camera));
  std::mt19937 random(7);
  for (int hole = 0; hole < 40; ++hole) {
    const int width = 1 + static_cast<int>(random() % 70), height = 1 + static_cast<int>(random() % 20);
    const cv::Rect place(static_cast<int>(random() % 250), static_cast<int>(random() % 220), width, height);
    table.depth_mm(place) = 0.0F;
  }
  const Scene scene(table.depth_mm, table.camera);
  ASSERT_GT(scene.segments.count(), 5);
  expect_as_slow(scene);
}

// A board before a wall: the border is the board's. Seen through a hole in the board, the wall owns none.
TEST(BorderOwnership, BelongsToTheNearerSide) {
  cv::Mat1f depth(240, 320, 2000.0F);
  depth(cv::Rect(80, 40, 160, 160)) = 1500.0F;
  depth(cv::Rect(140, 100, 40, 40)) = 2000.0F;
  const Scene scene(depth, Intrinsics::guess_for(depth.size()));
  EXPECT_EQ(scene.borders.front_share(scene.segment_at(60, 100)), 1);
  EXPECT_EQ(scene.borders.front_share(scene.segment_at(120, 160)), 0);
  EXPECT_EQ(scene.borders.front_share(scene.segment_at(10, 10)), 0);
}

TEST(BorderOwnership, ReachesAcrossGapsUpToTheWidest) {
  for (const int gap : {10, 11}) {
    cv::Mat1f depth(240, 320, 2000.0F);
    depth(cv::Rect(100, 40, 160, 160)) = 1500.0F;
    depth(cv::Rect(100 - 4 * gap, 0, 4 * gap, 240)) = 0.0F;  // the shadow on its left
    const Scene scene(depth, Intrinsics::guess_for(depth.size()));
    EXPECT_FLOAT_EQ(scene.borders.front_share(scene.segment_at(120, 180)), gap == 10 ? 1.0F : 0.75F);
  }
}

}  // namespace
}  // namespace saccade
