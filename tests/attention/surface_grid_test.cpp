#include "attention/surface_grid.hpp"

#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "table_scene.hpp"

namespace saccade {
namespace {

// Depth of a cell as its documentation says it, in double.
double slow_depth(const cv::Mat1f& depth, int row, int col) {
  const int order[] = {1, 2, 0, 3};
  const auto at = [&](int v, int u) {
    const int r = row * kCell + v, c = col * kCell + u;
    return r < depth.rows && c < depth.cols ? static_cast<double>(depth(r, c)) : 0.0;
  };
  double z0 = 0;
  for (int v : order)
    for (int u : order)
      if (z0 == 0) z0 = at(v, u);
  double sum = 0, count = 0;
  for (int v = 0; v < kCell; ++v)
    for (int u = 0; u < kCell; ++u)
      if (at(v, u) > 0 && std::abs(at(v, u) - z0) <= 0.02 * z0) sum += at(v, u), count += 1;
  return count > 0 ? sum / count : 0;
}

// Normal equations of 1/z = a*col + b*row + c over the 5 x 5 cells, solved in double by OpenCV.
std::optional<cv::Vec3d> slow_normal(const cv::Mat1d& z, const Intrinsics& camera, int row, int col) {
  std::vector<cv::Vec3d> rays;
  std::vector<double> inverse;
  for (int r = std::max(0, row - 2); r <= std::min(z.rows - 1, row + 2); ++r)
    for (int c = std::max(0, col - 2); c <= std::min(z.cols - 1, col + 2); ++c)
      if (z(r, c) > 0 && std::abs(z(r, c) - z(row, col)) <= 0.02 * z(row, col)) {
        rays.emplace_back((c * kCell + 1.5 - camera.cx) / camera.fx,
                          (r * kCell + 1.5 - camera.cy) / camera.fy, 1);
        inverse.push_back(1000 / z(r, c));
      }
  if (rays.size() < 6) return std::nullopt;
  const cv::Mat a = cv::Mat(rays).reshape(1), b(inverse);
  cv::Mat1d solution;
  if (!cv::solve(a, b, solution, cv::DECOMP_SVD)) return std::nullopt;
  const cv::Vec3d n(-solution(0), -solution(1), -solution(2));
  return n / cv::norm(n);
}

void expect_grid_as_slow(const cv::Mat1f& depth, const Intrinsics& camera) {
  SurfaceGrid grid;
  grid.build(depth, camera);
  ASSERT_EQ(grid.rows(), (depth.rows + 3) / 4);
  ASSERT_EQ(grid.cols(), (depth.cols + 3) / 4);
  cv::Mat1d z(grid.rows(), grid.cols());
  std::size_t i = 0;
  int normals = 0;
  for (int r = 0; r < z.rows; ++r)
    for (int c = 0; c < z.cols; ++c, ++i) {
      z(r, c) = static_cast<double>(grid.depth_mm()[i]);
      EXPECT_NEAR(z(r, c), slow_depth(depth, r, c), 1e-3) << r << ' ' << c;
    }
  i = 0;
  for (int r = 0; r < z.rows; ++r)
    for (int c = 0; c < z.cols; ++c, ++i) {
      const cv::Vec3d n(static_cast<double>(grid.normal_x()[i]), static_cast<double>(grid.normal_y()[i]),
                        static_cast<double>(grid.normal_z()[i]));
      if (n == cv::Vec3d() || z(r, c) == 0) continue;
      ++normals;
      const auto slow = slow_normal(z, camera, r, c);
      ASSERT_TRUE(slow) << r << ' ' << c;
      EXPECT_LT(cv::norm(n - *slow), 2e-3) << r << ' ' << c;
    }
  EXPECT_GT(normals, 100);
}

TEST(SurfaceGrid, DepthAndNormalsAreThoseOfTheSlowForm) {
  TableScene scene = look_at_table({box(0, 100, 150, 120, 130), ball(-250, 0, 70)}, {161, 122});
  expect_grid_as_slow(scene.depth_mm, scene.camera);
  std::mt19937 random(5);
  for (float& z : scene.depth_mm)
    z = random() % 10 == 0 ? 0 : std::round(z + static_cast<float>(random() % 7) - 3.0F);
  expect_grid_as_slow(scene.depth_mm, scene.camera);
}

TEST(SurfaceGrid, LinksEndAtADepthJumpAndGoBothWays) {
  cv::Mat1f depth(32, 64, 1000.0F);
  depth(cv::Rect(32, 0, 32, 32)) = 1100.0F;
  depth(cv::Rect(0, 16, 16, 4)) = 0.0F;
  SurfaceGrid grid;
  grid.build(depth, Intrinsics::guess_for(depth.size()));
  for (int r = 0; r < grid.rows(); ++r)
    for (int c = 0; c < grid.cols(); ++c) {
      const auto i = static_cast<std::size_t>(r * grid.cols() + c);
      const bool gap = r == 4 && c < 4, right_gap = r == 4 && c + 1 < 4, down_gap = r + 1 == 4 && c < 4;
      const bool right = c + 1 < grid.cols() && c != 7 && !gap && !right_gap;
      const bool down = r + 1 < grid.rows() && !gap && !down_gap;
      EXPECT_EQ((grid.links()[i] & SurfaceGrid::kRight) != 0, right) << r << ' ' << c;
      EXPECT_EQ((grid.links()[i] & SurfaceGrid::kDown) != 0, down) << r << ' ' << c;
      if (right) {
        EXPECT_TRUE(grid.links()[i + 1] & SurfaceGrid::kLeft);
      }
      if (down) {
        EXPECT_TRUE(grid.links()[i + static_cast<std::size_t>(grid.cols())] & SurfaceGrid::kUp);
      }
    }
}

// The rule of README.md, section 2, for two neighbours, in double.
bool slow_linked(const SurfaceGrid& grid, std::size_t a, std::size_t b) {
  const auto point = [&](std::size_t i) {
    const int row = static_cast<int>(i) / grid.cols(), col = static_cast<int>(i) % grid.cols();
    return grid.camera().point_mm(row, col, static_cast<double>(grid.depth_mm()[i]));
  };
  const cv::Point3d p = point(a), q = point(b);
  const double jump = 0.012 * p.z * std::max(1.0, p.z / 1000);
  const auto off_plane = [&](std::size_t i) {
    const cv::Point3d n(static_cast<double>(grid.normal_x()[i]), static_cast<double>(grid.normal_y()[i]),
                        static_cast<double>(grid.normal_z()[i]));
    return n == cv::Point3d() ? 1e9 : std::abs(n.dot(q - p));
  };
  return p.z > 0 && q.z > 0 && (std::abs(q.z - p.z) < jump || off_plane(a) < jump || off_plane(b) < jump);
}

TEST(SurfaceGrid, LinksAreThoseOfTheSlowForm) {
  TableScene scene = look_at_table({box(0, 100, 150, 120, 130), ball(-250, 0, 70)}, {161, 122});
  std::mt19937 random(6);
  for (float& z : scene.depth_mm)
    z = random() % 4 == 0 ? 0.0F : z * 2 + static_cast<float>(random() % 1000) * 0.06F - 30.0F;
  SurfaceGrid grid;
  grid.build(scene.depth_mm, scene.camera);
  const auto cols = static_cast<std::size_t>(grid.cols());
  int links = 0, jumps = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const bool has_right = i % cols + 1 < cols, has_down = i + cols < grid.size();
    const bool right = has_right && slow_linked(grid, i, i + 1),
               down = has_down && slow_linked(grid, i, i + cols);
    EXPECT_EQ((grid.links()[i] & SurfaceGrid::kRight) != 0, right) << i;
    EXPECT_EQ((grid.links()[i] & SurfaceGrid::kDown) != 0, down) << i;
    EXPECT_EQ(has_right && (grid.links()[i + 1] & SurfaceGrid::kLeft) != 0, right) << i;
    EXPECT_EQ(has_down && (grid.links()[i + cols] & SurfaceGrid::kUp) != 0, down) << i;
    links += right + down;
    jumps += (has_right && !right) + (has_down && !down);
  }
  EXPECT_GT(links, 500);
  EXPECT_GT(jumps, 100);
}

TEST(SurfaceGrid, ConcaveEdgesAreOnesAndConvexEdgesAreNone) {
  const TableScene scene = look_at_table({box(0, 0, 300, 200, 150)});
  SurfaceGrid grid;
  grid.build(scene.depth_mm, scene.camera);
  const int col = 80;  // the middle column crosses front foot (concave), front top edge (convex)
  int foot = 0, edge = 0;
  for (int r = 1; r < 120; ++r) {
    const int above = scene.labels((r - 1) * 4 + 2, col * 4), here = scene.labels(r * 4 + 2, col * 4);
    if (above == 1 && here == 0) foot = r;
  }
  for (int r = 1; r < foot; ++r)
    if (scene.labels(r * 4, col * 4) == 1 && !edge) edge = r;
  ASSERT_GT(foot, edge + 10);
  const auto convex = [&](int row) {
    return grid.convex()[static_cast<std::size_t>(row * grid.cols() + col)] != 0;
  };
  EXPECT_FALSE(convex(foot));
  for (int r = edge + 3; r < foot - 3; ++r) EXPECT_TRUE(convex(r)) << r;
}

}  // namespace
}  // namespace saccade
