#include "attention/plane_search.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "table_scene.hpp"

namespace saccade {
namespace {

cv::Vec3d plane_at(const std::vector<cv::Vec3d>& cells) {  // (col, row, 1/z) of each
  cv::Mat1d a(static_cast<int>(cells.size()), 3), b(static_cast<int>(cells.size()), 1), solution;
  for (int i = 0; i < a.rows; ++i) {
    const cv::Vec3d& cell = cells[static_cast<std::size_t>(i)];
    a(i, 0) = cell[0], a(i, 1) = cell[1], a(i, 2) = 1, b(i) = cell[2];
  }
  cv::solve(a, b, solution, cv::DECOMP_SVD);
  return {solution(0), solution(1), solution(2)};
}

std::vector<cv::Vec3d> near(const std::vector<cv::Vec3d>& cells, const cv::Vec3d& plane, double reach) {
  std::vector<cv::Vec3d> found;
  for (const cv::Vec3d& cell : cells)
    if (std::abs(plane[0] * cell[0] + plane[1] * cell[1] + plane[2] - cell[2]) <= reach * cell[2])
      found.push_back(cell);
  return found;
}

// The search as README.md, section 4, has it: every candidate through the point p = z * ray of its cell, in
// double, by solving for each cell where its ray meets the plane.
std::optional<PlaneSearch::Found> slow_search(const SurfaceGrid& grid, const std::vector<int>& cells) {
  std::vector<cv::Vec3d> counted;
  std::vector<int> with_normal;
  for (const int i : cells) {
    const int row = i / grid.cols(), col = i % grid.cols();
    if (row % 2 == 0 && col % 2 == 0)
      counted.emplace_back(col, row, grid.inverse_depth()[static_cast<std::size_t>(i)]);
    if (grid.normal_z()[static_cast<std::size_t>(i)] != 0) with_normal.push_back(i);
  }
  if (with_normal.size() < 20) return std::nullopt;
  const Intrinsics& camera = grid.camera();
  std::size_t most = 0;
  cv::Vec3d plane;
  for (std::size_t k = 0; k < 150; ++k) {
    const int i = with_normal[k * (with_normal.size() - 1) / 149];
    const auto at = static_cast<std::size_t>(i);
    const cv::Point3d n(grid.normal_x()[at], grid.normal_y()[at], grid.normal_z()[at]),
        p = camera.point_mm(i / grid.cols(), i % grid.cols(), grid.depth_mm()[at]);
    std::size_t votes = 0;
    for (const cv::Vec3d& cell : counted) {
      const double inverse = n.dot(camera.point_mm(cell[1], cell[0], 1)) / n.dot(p);
      if (std::abs(inverse - cell[2]) <= 0.02 * cell[2]) ++votes;
    }
    if (votes <= most) continue;
    most = votes;
    const auto inverse_at = [&](double row, double col) {
      return n.dot(camera.point_mm(row, col, 1)) / n.dot(p);
    };
    plane = {inverse_at(0, 1) - inverse_at(0, 0), inverse_at(1, 0) - inverse_at(0, 0), inverse_at(0, 0)};
  }
  for (int round = 0; round < 4; ++round) plane = plane_at(near(counted, plane, round == 0 ? 0.024 : 0.012));
  const double share = static_cast<double>(near(counted, plane, 0.012).size());
  return PlaneSearch::Found{{plane[0], plane[1], plane[2]}, share / static_cast<double>(counted.size())};
}

void expect_as_slow(const SurfaceGrid& grid, const std::vector<int>& cells) {
  PlaneSearch search;
  const auto fast = search.find(grid, cells), slow = slow_search(grid, cells);
  ASSERT_EQ(fast.has_value(), slow.has_value());
  if (!fast) return;
  EXPECT_NEAR(fast->share, slow->share, 0.01);
  for (const int i : cells) {
    const int row = i / grid.cols(), col = i % grid.cols();
    EXPECT_NEAR(fast->plane.at(row, col) / slow->plane.at(row, col), 1, 0.002) << i;
  }
}

std::vector<int> cells_with_depth(const SurfaceGrid& grid) {
  std::vector<int> cells;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (grid.depth_mm()[i] > 0) cells.push_back(static_cast<int>(i));
  return cells;
}

TEST(PlaneSearch, IsAsTheSlowForm) {
  TableScene scene = look_at_table({box(0, 100, 250, 120, 130), ball(-250, 0, 70)}, {320, 240});
  std::mt19937 random(5);
  for (int noise : {1, 9}) {
    for (float& z : scene.depth_mm)
      if (z > 0) z = std::round(z + static_cast<float>(random() % static_cast<unsigned>(noise)));
    SurfaceGrid grid;
    grid.build(scene.depth_mm, scene.camera);
    expect_as_slow(grid, cells_with_depth(grid));
  }
}

// A floor and, as large as a third of it, a wall behind: least squares over both gives neither.
TEST(PlaneSearch, FindsTheLargestOfSeveralPlanes) {
  const Intrinsics camera = Intrinsics::guess_for({320, 240});
  cv::Mat1f depth(240, 320);
  for (int r = 0; r < depth.rows; ++r)
    for (int c = 0; c < depth.cols; ++c)
      depth(r, c) = r < 60 ? 3000 : 3000 / (1 + static_cast<float>(r - 60) / 60);
  SurfaceGrid grid;
  grid.build(depth, camera);
  PlaneSearch search;
  const auto found = search.find(grid, cells_with_depth(grid));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->share, 0.75, 0.03);
  const auto off = [&](int row) {
    constexpr int kCol = 40;
    const double w =
        static_cast<double>(grid.inverse_depth()[static_cast<std::size_t>(row * grid.cols() + kCol)]);
    return std::abs(found->plane.at(row, kCol) - w) / w;
  };
  EXPECT_LT(off(50), 0.002);  // floor
  EXPECT_GT(off(2), 0.1);     // wall
}

TEST(PlaneSearch, TooFewCellsOrALineAreNoPlane) {
  const cv::Mat1f depth(40, 40, 1000.0F);
  SurfaceGrid grid;
  grid.build(depth, Intrinsics::guess_for(depth.size()));
  PlaneSearch search;
  EXPECT_FALSE(search.find(grid, {}));
  const std::vector<int> few = {0, 1, 2, 10, 11, 12};
  EXPECT_FALSE(search.find(grid, few));
  std::vector<int> column(10);
  for (int r = 0; r < 10; ++r) column[static_cast<std::size_t>(r)] = r * grid.cols() + 4;
  EXPECT_FALSE(search.find(grid, column));
}

}  // namespace
}  // namespace saccade
