#include "attention/surface_segments.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "table_scene.hpp"

namespace saccade {
namespace {

TEST(SurfaceSegments, SeparatesThingsFromTheTableAndFindsTheTableAsSupportingPlane) {
  const TableScene scene = look_at_table({box(-150, 0, 120, 100, 120), ball(150, 0, 60)});
  SurfaceGrid grid;
  grid.build(scene.depth_mm, scene.camera);
  SurfaceSegments segments;
  segments.grow(grid);
  const auto segment_at = [&](cv::Point p) {
    return segments.of_cell()[static_cast<std::size_t>(p.y / 4 * grid.cols() + p.x / 4)];
  };
  const int first = segment_at(middle_of(scene.labels, 1)), second = segment_at(middle_of(scene.labels, 2)),
            table = segment_at({320, 460});
  ASSERT_GE(std::min({first, second, table}), 0);
  EXPECT_NE(first, table);
  EXPECT_NE(second, table);
  EXPECT_NE(first, second);
  EXPECT_TRUE(segments.is_supporting_plane(table));
  EXPECT_FALSE(segments.is_supporting_plane(first));
  EXPECT_FALSE(segments.is_supporting_plane(second));
}

// The slow form of a segment: take in any cell that touches it by a link, until nothing changes.
TEST(SurfaceSegments, ConvexCellsOfASegmentAreExactlyThoseThatCanBeReached) {
  const TableScene scene = look_at_table({box(-60, 0, 119, 100, 90), box(60, 30, 120, 100, 140)}, {320, 240});
  SurfaceGrid grid;
  grid.build(scene.depth_mm, scene.camera);
  SurfaceSegments segments;
  segments.grow(grid);
  const auto& convex = grid.convex();
  for (int label : {1, 2}) {
    const cv::Point middle = middle_of(scene.labels, label);
    const std::size_t seed = static_cast<std::size_t>(middle.y / 4 * grid.cols() + middle.x / 4);
    ASSERT_TRUE(convex[seed]);
    std::vector<char> in(grid.size(), 0);
    in[seed] = 1;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < grid.size(); ++i) {
        if (in[i] || !convex[i]) continue;
        const auto width = static_cast<std::size_t>(grid.cols());
        const int links = grid.links()[i];
        if (((links & SurfaceGrid::kRight) && in[i + 1]) || ((links & SurfaceGrid::kLeft) && in[i - 1]) ||
            ((links & SurfaceGrid::kDown) && in[i + width]) || ((links & SurfaceGrid::kUp) && in[i - width]))
          in[i] = 1, changed = true;
      }
    }
    const int segment = segments.of_cell()[seed];
    ASSERT_FALSE(segments.is_supporting_plane(segment));
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (convex[i]) {
        EXPECT_EQ(in[i] != 0, segments.of_cell()[i] == segment) << i;
      }
  }
}

TEST(SurfaceSegments, NothingValidMakesNone) {
  SurfaceGrid grid;
  grid.build(cv::Mat1f(30, 50, 0.0F), Intrinsics::guess_for({50, 30}));
  SurfaceSegments segments;
  segments.grow(grid);
  EXPECT_EQ(segments.count(), 0);
  for (int segment : segments.of_cell()) EXPECT_EQ(segment, SurfaceSegments::kNone);
}

}  // namespace
}  // namespace saccade
