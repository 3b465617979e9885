// The reference operator against results worked out by hand.

#include "saliency/reference.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shapes.hpp"

namespace saccade::test {
namespace {

using Eigen::Vector3d;

// ---- pyramid

TEST(ReferencePyramid, KeepsInvalidEvenPixelsAndAveragesOnlyValidOnes) {
  cv::Mat1d depth(9, 9, 1000.0);
  depth(4, 4) = 0;
  depth(2, 3) = 0;
  const cv::Mat1d half = reference::halve(depth);
  ASSERT_EQ(half.size(), cv::Size(5, 5));
  EXPECT_EQ(half(2, 2), 0);
  EXPECT_EQ(half(1, 1), 1000);  // the hole beside it has no weight
}

TEST(ReferencePyramid, WeighsWithTheBinomialAndRoundsToEighths) {
  cv::Mat1d depth(9, 9, 1000.0);
  depth(4, 4) = 1010;  // centre: weight 36 of 256
  const cv::Mat1d half = reference::halve(depth);
  EXPECT_EQ(half(2, 2), 1001.375);  // 1000 + 10 * 36/256 = 1001.40625
  EXPECT_EQ(half(1, 2), 1000.25);   // two rows up: 10 * 6/256 = 0.234
  EXPECT_EQ(half(1, 1), 1000);      // 10 * 1/256 = 0.04
}

TEST(ReferencePyramid, ReflectsAtTheBorderWithoutRepeatingIt) {
  cv::Mat1d depth(8, 8, 1000.0);
  depth.col(1) = 1016;  // at column 0 it counts on both sides: 8 of 16
  const cv::Mat1d half = reference::halve(depth);
  EXPECT_EQ(half(2, 0), 1008);
  EXPECT_EQ(half(0, 0), 1008);
}

TEST(ReferencePyramid, ReflectsBackAndForthInTinyImages) {
  cv::Mat1d depth(1, 2);
  depth(0, 0) = 800;
  depth(0, 1) = 816;
  const cv::Mat1d half = reference::halve(depth);
  ASSERT_EQ(half.size(), cv::Size(1, 1));
  EXPECT_EQ(half(0, 0), 808);  // columns -2..2 are 0 1 0 1 0: weights 1+6+1 and 4+4
}

// ---- normals

TEST(ReferenceNormals, OfAPlaneAreItsNormal) {
  const cv::Size size(40, 30);
  const Intrinsics camera = camera_for(size);
  const cv::Vec3d n = cv::normalize(cv::Vec3d(0.1, -0.2, 1));
  const cv::Mat1d depth = to_double(plane_depth(size, camera, n, 900));
  const auto level = reference::make_level(depth, camera);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      EXPECT_LT(cv::norm(level.normals(r, c) + n), 2e-4);  // depth is stored in float
      EXPECT_LT(level.normals(r, c).dot(level.points_mm(r, c)), 0);
    }
}

TEST(ReferenceNormals, LeaveOutWhatIsMoreThanTwoPercentAway) {
  const Intrinsics camera = camera_for({16, 16});
  cv::Mat1d depth(16, 16, 1000.0);
  depth.colRange(8, 16) = 1020;  // just within
  EXPECT_GT(std::abs(reference::make_level(depth, camera).normals(8, 7)[0]), 0.05);
  depth.colRange(8, 16) = 1020.125;
  EXPECT_NEAR(reference::make_level(depth, camera).normals(8, 7)[0], 0, 1e-12);
}

TEST(ReferenceNormals, NeedThreePixelsThatAreNotOnALine) {
  const Intrinsics camera = camera_for({9, 9});
  cv::Mat1d depth(9, 9, 0.0);
  depth(4, 4) = depth(4, 5) = 500;
  EXPECT_EQ(reference::make_level(depth, camera).normals(4, 4), cv::Vec3d());
  depth(4, 3) = 500;
  EXPECT_EQ(reference::make_level(depth, camera).normals(4, 4), cv::Vec3d());
  depth(3, 4) = 500;
  EXPECT_NEAR(reference::make_level(depth, camera).normals(4, 4)[2], -1, 1e-12);
}

// ---- one plane's equations

// Two points beside a centre, seen by a camera of f = 1 so that points can be chosen freely.
reference::Level level_of(const std::vector<cv::Vec3d>& points, const std::vector<cv::Vec3d>& normals) {
  const int n = static_cast<int>(points.size());
  reference::Level level{
      cv::Mat1d(1, n), cv::Mat3d(1, n), cv::Mat3d(1, n), {1, 1, 0, 0, IntrinsicsOrigin::option}};
  for (int i = 0; i < n; ++i) {
    level.points_mm(0, i) = points[static_cast<std::size_t>(i)];
    level.depth_mm(0, i) = points[static_cast<std::size_t>(i)][2];
    level.normals(0, i) = normals[static_cast<std::size_t>(i)];
  }
  return level;
}

TEST(ReferencePlane, ThreePointsByHand) {
  // A roof: left and right normals lean 45 degrees away, the ridge between them looks at the camera.
  const double s = std::sqrt(0.5);
  const auto level =
      level_of({{-3, 0, 102}, {0, 0, 100}, {5, 0, 106}}, {{-s, 0, -s}, {0, 0, -1}, {s, 0, -s}});
  Symmetry3dParams params;
  params.kernel = 3;
  params.length_scale = LengthScale::millimetre;
  const auto pixel = reference::symmetry_at(level, 0, 1, params);
  ASSERT_TRUE(pixel);
  // Covariance: diag(1/3, 0, var z); the plane that matters has gamma = (1, 0, 0).
  const auto plane = std::max_element(
      pixel->planes.begin(), pixel->planes.end(),
      [](const auto& a, const auto& b) { return std::abs(a.gamma.x()) < std::abs(b.gamma.x()); });
  EXPECT_NEAR(std::abs(plane->gamma.x()), 1, 1e-12);
  EXPECT_NEAR(plane->delta_D_mm, 4, 1e-12);  // |106 - 102|
  EXPECT_NEAR(plane->delta_d_mm, 2, 1e-12);  // ||5| - |-3||
  // l = (8, 0, 4)/sqrt(80); n'.l = s*(8 - 4)/sqrt(80), n''.l = s*(-8 - 4)/sqrt(80).
  EXPECT_NEAR(plane->omega_2, std::pow(s * 16 / std::sqrt(80.0), 2), 1e-12);
  EXPECT_NEAR(plane->omega_1, 1, 1e-12);  // N = (0, +-1, 0) is at right angles to l
  EXPECT_NEAR(plane->score, std::exp(-6.0) * plane->omega_2, 1e-12);
  EXPECT_NEAR(pixel->score(), plane->score, 1e-12);
}

TEST(ReferencePlane, RelativeLengthScaleIsFivePercentOfTheWindow) {
  const double s = std::sqrt(0.5);
  const auto level =
      level_of({{-3, 0, 102}, {0, 0, 100}, {5, 0, 106}}, {{-s, 0, -s}, {0, 0, -1}, {s, 0, -s}});
  Symmetry3dParams params;
  params.kernel = 3;
  const auto pixel = reference::symmetry_at(level, 0, 1, params);
  const double lambda = 0.05 * 3 * 100 / 1;
  EXPECT_NEAR(pixel->score(), std::exp(-6 / lambda) * std::pow(s * 16 / std::sqrt(80.0), 2), 1e-12);
}

TEST(ReferencePlane, OneSidedWindowsScoreNothing) {
  const double s = std::sqrt(0.5);
  const auto level =
      level_of({{0, 0, 100}, {3, 0, 101}, {5, 0, 102}}, {{0, 0, -1}, {s, 0, -s}, {0.8, 0, -0.6}});
  Symmetry3dParams params;
  params.kernel = 5;
  EXPECT_EQ(reference::symmetry_at(level, 0, 0, params)->score(), 0);
}

TEST(ReferencePlane, PointsOnThePlaneAreInNeitherHalf) {
  const double s = std::sqrt(0.5);
  // The fourth point lies on the plane x = 0 through the centre; its odd depth must not enter Delta D.
  const auto level = level_of({{-4, 0, 104}, {0, 0, 100}, {4, 0, 104}, {0, 0, 160}},
                              {{-s, 0, -s}, {0, 0, -1}, {s, 0, -s}, {0, 0, -1}});
  Symmetry3dParams params;
  params.kernel = 5;
  const auto pixel = reference::symmetry_at(level, 0, 1, params);
  EXPECT_NEAR(pixel->score(), 2, 1e-12);  // (n'.l - n''.l)^2 = (2 * sqrt(1/2))^2, no distance
}

TEST(ReferencePlane, PixelsWithoutANormalAreNoPoints) {
  const auto level = level_of({{-4, 0, 104}, {0, 0, 100}}, {{-1, 0, 0}, {0, 0, 0}});
  EXPECT_FALSE(reference::symmetry_at(level, 0, 1, Symmetry3dParams()));
}

// Eq. (12) is (n'.l - n''.l)^2, which is how the production form computes it.
TEST(ReferencePlane, OmegaTwoIsTheSquaredDifferenceOfCosines) {
  const cv::Mat1f depth = ball_scene({60, 45}, 51);
  const auto level = reference::make_level(to_double(depth), camera_for(depth.size()));
  Symmetry3dParams params;
  params.kernel = 9;
  int checked = 0;
  for (int r = 5; r < 40; r += 3)
    for (int c = 5; c < 55; c += 3) {
      const auto pixel = reference::symmetry_at(level, r, c, params);
      if (!pixel) continue;
      for (const auto& plane : pixel->planes) {
        Vector3d points[2] = {Vector3d::Zero(), Vector3d::Zero()},
                 normals[2] = {Vector3d::Zero(), Vector3d::Zero()};
        double counts[2] = {0, 0};
        const cv::Vec3d p = level.points_mm(r, c);
        for (int v = -4; v <= 4; ++v)
          for (int u = -4; u <= 4; ++u) {
            if (level.normals(r + v, c + u) == cv::Vec3d()) continue;
            const cv::Vec3d q = level.points_mm(r + v, c + u), n = level.normals(r + v, c + u);
            const double d = plane.gamma.dot(Vector3d(q[0] - p[0], q[1] - p[1], q[2] - p[2]));
            if (d == 0) continue;
            points[d < 0] += Vector3d(q[0], q[1], q[2]);
            normals[d < 0] += Vector3d(n[0], n[1], n[2]);
            counts[d < 0] += 1;
          }
        if (counts[0] == 0 || counts[1] == 0) continue;
        const Vector3d l = (points[0] / counts[0] - points[1] / counts[1]).normalized();
        const double difference = normals[0].normalized().dot(l) - normals[1].normalized().dot(l);
        EXPECT_NEAR(plane.omega_2, difference * difference, 1e-9);
        ++checked;
      }
    }
  EXPECT_GT(checked, 300);
}

// ---- maps

// Seen closely enough that the sides of a ridge pass the 2 % test of the normals.
constexpr Intrinsics kClose{525, 525, 30, 20, IntrinsicsOrigin::option};

TEST(ReferenceMap, ARidgeIsSalientAndItsSidesAreNot) {
  const cv::Mat1f depth = ridge_depth({61, 41}, kClose, 800, 1);
  Symmetry3dParams params;
  params.kernel = 11;
  const auto map = reference::symmetry_map(reference::make_level(to_double(depth), kClose), params);
  EXPECT_GT(map(20, 30), 1);  // sides at right angles: omega_2 = 2 far from the ridge
  for (const int beside : {3, 6}) {
    EXPECT_LT(map(20, 30 + beside), map(20, 30));
    EXPECT_NEAR(map(20, 30 + beside), map(20, 30 - beside), 1e-3);  // depth is stored in float
  }
  EXPECT_LT(map(20, 45), 1e-6);
}

TEST(ReferenceMap, AConcaveValleyIsNotSalient) {
  const cv::Mat1f depth = ridge_depth({61, 41}, kClose, 800, -1);
  Symmetry3dParams params;
  params.kernel = 11;
  const auto map = reference::symmetry_map(reference::make_level(to_double(depth), kClose), params);
  double maximum = 0;
  cv::minMaxLoc(map, nullptr, &maximum);
  EXPECT_LT(maximum, 1e-6);
}

TEST(ReferenceMap, StaysBetweenZeroAndFour) {
  const cv::Mat1f depth = ball_scene({70, 50}, 52);
  Symmetry3dParams params;
  params.kernel = 7;
  const auto map =
      reference::symmetry_map(reference::make_level(to_double(depth), camera_for(depth.size())), params);
  double minimum = 0, maximum = 0;
  cv::minMaxLoc(map, &minimum, &maximum);
  EXPECT_EQ(minimum, 0);
  EXPECT_LE(maximum, 4);
  EXPECT_GT(maximum, 0.1);
}

TEST(ReferenceMap, WindowsEndAtTheBorder) {
  // The upper left pixel of an image is that of a larger one whose other part has no readings.
  const Intrinsics camera = camera_for({64, 48});
  const cv::Mat1f depth = ball_scene({64, 48}, 53);
  cv::Mat1d larger(64, 80, 0.0);
  to_double(depth).copyTo(larger(cv::Rect(16, 16, 64, 48)));
  Intrinsics shifted = camera;
  shifted.cx += 16;
  shifted.cy += 16;
  const auto inner = reference::make_level(to_double(depth), camera),
             outer = reference::make_level(larger, shifted);
  for (const auto& [row, col] : {std::pair(0, 0), {1, 63}, {47, 5}, {20, 0}}) {
    const auto a = reference::symmetry_at(inner, row, col, {}),
               b = reference::symmetry_at(outer, row + 16, col + 16, {});
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_NEAR(a->score(), b->score(), 1e-9);
    }
  }
}

TEST(ReferenceMap, MasterMapPutsLevelPixelsWhereTheyWere) {
  std::vector<cv::Mat1d> maps = {cv::Mat1d(9, 9, 0.0), cv::Mat1d(5, 5, 0.0), cv::Mat1d(3, 3, 0.0)};
  maps[2](1, 1) = 1;  // pixel (4, 4) of level 0
  cv::Mat1d master = reference::master_map(maps, 0, {9, 9}, LevelNormalisation::none);
  EXPECT_EQ(master(4, 4), 1);
  EXPECT_EQ(master(4, 6), 0.5);
  EXPECT_EQ(master(5, 5), 0.75 * 0.75);
  EXPECT_EQ(master(4, 8), 0);
  maps[2] = cv::Mat1d(3, 3, 0.0);
  maps[1](4, 4) = 2;  // the last pixel holds up to the border
  master = reference::master_map(maps, 0, {10, 10}, LevelNormalisation::none);
  EXPECT_EQ(master(9, 9), 2);
}

TEST(ReferenceMap, NormalisationsOfLevels) {
  cv::Mat1d lonely = cv::Mat1d(11, 11, 0.0), crowded = cv::Mat1d(11, 11, 0.0);
  lonely(5, 5) = 2;
  crowded(2, 2) = crowded(2, 8) = crowded(8, 2) = 2;
  crowded(8, 8) = 1;
  const auto master = [](const cv::Mat1d& map, LevelNormalisation kind) {
    return reference::master_map({map}, 0, map.size(), kind);
  };
  EXPECT_EQ(master(lonely, LevelNormalisation::max)(5, 5), 1);
  EXPECT_EQ(master(crowded, LevelNormalisation::max)(8, 8), 0.5);
  EXPECT_EQ(master(lonely, LevelNormalisation::itti)(5, 5), 1);
  // Other peaks than the first of the highest: 1, 1 and 1/2 of the maximum.
  const double weight = std::pow(1 - 2.5 / 3, 2);
  EXPECT_NEAR(master(crowded, LevelNormalisation::itti)(2, 2), weight, 1e-12);
  EXPECT_EQ(cv::norm(master(cv::Mat1d(11, 11, 0.0), LevelNormalisation::itti)), 0);
}

}  // namespace
}  // namespace saccade::test
