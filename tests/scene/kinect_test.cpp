#include "scene/kinect.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "camera.hpp"

namespace saccade::scene {
namespace {

// Walls and boxes seen from the origin, which looks along +y of the world.
Scene world_of(std::vector<Part> parts) {
  Scene scene;
  scene.parts = std::move(parts);
  scene.light_mm = {0, 0, 500};
  scene.eye_mm = Vector3d::Zero();
  scene.target_mm = {0, 1000, 0};
  scene.sway_rad = 0;
  for (const Part& part : scene.parts) scene.objects = std::max(scene.objects, part.label);
  return scene;
}

Part wall(double distance_mm, double turn_degrees = 0) {
  const double angle = turn_degrees * 3.14159265358979 / 180;
  Matrix3d turn;
  turn << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  return {
      Box{{20000, 10, 20000}}, Vector3d(0, distance_mm, 0) + turn * Vector3d(0, 10, 0), turn, 0, {1, 1, 1}};
}

SceneRender view_of(const Scene& scene) {
  SceneRender view;
  render(scene, kCamera, kSize, scene.camera_at(0), view);
  return view;
}

cv::Mat1f sensed(const SceneRender& view, std::uint64_t key, const KinectProperties& properties = {}) {
  KinectModel model(properties);
  model.set_view(view, kCamera);
  cv::Mat1f depth;
  model.sense(key, depth);
  return depth;
}

KinectProperties noiseless() {
  KinectProperties properties;
  properties.smooth_noise = properties.white_noise = 0;
  properties.edge_loss = properties.random_loss = 0;
  return properties;
}

TEST(Kinect, DepthTakesTheStepsOfTheDisparityFormula) {
  // 580 px * 75 mm * 8 = 348000: the neighbours of 2 m are 348000/173, 348000/174, 348000/175.
  const cv::Mat1f depth = sensed(view_of(world_of({wall(2000, 5)})), 1, noiseless());
  const std::set<float> seen(depth.begin(), depth.end());
  for (const float z : {2012.f, 2000.f, 1989.f}) EXPECT_TRUE(seen.contains(z)) << z;
  EXPECT_GT(seen.size(), 10u);
  for (auto it = seen.begin(); it != seen.end(); ++it) {
    const double step = std::round(348000 / static_cast<double>(*it));
    EXPECT_EQ(*it, std::round(348000 / step));
    if (std::next(it) != seen.end()) {  // no step is left out
      EXPECT_EQ(*std::next(it), std::round(348000 / (step - 1)));
    }
  }
}

TEST(Kinect, WithoutNoiseTheErrorStaysWithinHalfAStep) {
  const SceneRender view = view_of(world_of({wall(1500, 10)}));
  const cv::Mat1f depth = sensed(view, 1, noiseless());
  for (int r = 0; r < kSize.height; ++r)
    for (int c = 0; c < kSize.width; ++c) {
      ASSERT_GT(depth(r, c), 0);
      const double z = view.depth_mm(r, c);
      ASSERT_LT(std::abs(depth(r, c) - z), 0.51 * z * z / 348000 + 0.6);
    }
}

// Root mean square of the error of one reading.
double error_at(double distance_mm) {
  const SceneRender view = view_of(world_of({wall(distance_mm, 5)}));
  const cv::Mat1f depth = sensed(view, 9);
  double squares = 0;
  int count = 0;
  for (int r = 0; r < kSize.height; ++r)
    for (int c = 150; c < 170; ++c) {
      if (depth(r, c) == 0) continue;
      squares += std::pow(depth(r, c) - view.depth_mm(r, c), 2);
      ++count;
    }
  EXPECT_GT(count, 4000);
  return std::sqrt(squares / count);
}

TEST(Kinect, NoiseGrowsWithTheSquareOfTheDepth) {
  // About half a step: 0.4 of noise and 1/sqrt(12) of quantisation, added in squares.
  for (const double z : {1000.0, 2000.0, 4000.0, 6000.0}) {
    const double expected = std::sqrt(0.32 * 0.32 + 0.24 * 0.24 + 1.0 / 12) * z * z / 348000;
    EXPECT_NEAR(error_at(z) / expected, 1, 0.12) << z;
  }
}

TEST(Kinect, NoiseOfNeighboursIsCorrelatedAndOfDistantPixelsIsNot) {
  const SceneRender view = view_of(world_of({wall(3000, 5)}));
  KinectProperties properties;
  properties.random_loss = 0;
  const cv::Mat1f depth = sensed(view, 2, properties);
  const auto correlation = [&](int shift) {
    double products = 0, squares = 0;
    for (int r = 0; r < kSize.height; ++r)
      for (int c = 0; c + shift < kSize.width; ++c) {
        const double a = depth(r, c) - view.depth_mm(r, c);
        products += a * (depth(r, c + shift) - view.depth_mm(r, c + shift));
        squares += a * a;
      }
    return products / squares;
  };
  EXPECT_GT(correlation(1), 0.2);
  EXPECT_LT(correlation(1), 0.9);
  EXPECT_LT(std::abs(correlation(24)), 0.1);
}

TEST(Kinect, ReadingsAreIntegerMillimetresAndMissingAtRandomAsOftenAsSpecified) {
  const cv::Mat1f depth = sensed(view_of(world_of({wall(1500)})), 3);
  int missing = 0;
  for (const float z : depth) {
    missing += z == 0;
    ASSERT_EQ(z, std::round(z));
  }
  EXPECT_NEAR(missing / static_cast<double>(depth.total()), 0.002, 0.0008);
}

TEST(Kinect, NothingIsReadTooNearOrTooFar) {
  for (const double distance : {430.0, 9500.0})
    EXPECT_EQ(cv::countNonZero(sensed(view_of(world_of({wall(distance)})), 1)), 0) << distance;
  for (const double distance : {480.0, 8000.0})
    EXPECT_GT(cv::countNonZero(sensed(view_of(world_of({wall(distance)})), 1)), 70'000) << distance;
  EXPECT_EQ(cv::countNonZero(sensed(view_of(world_of({})), 1)), 0);
}

TEST(Kinect, SurfacesSeenAtAGrazingAngleAreLost) {
  const Part floor{Box{{20000, 20000, 10}}, {0, 0, -310}, Matrix3d::Identity(), 0, {1, 1, 1}};
  const SceneRender view = view_of(world_of({floor}));
  const cv::Mat1f depth = sensed(view, 1);
  // 300 mm below the camera, the horizon at row 119.5: well in range, but seen at less than 4 degrees.
  for (int r = 130; r < 137; ++r) ASSERT_LT(view.depth_mm(r, 160), 8000);
  EXPECT_EQ(cv::countNonZero(depth.rowRange(130, 137)), 0);
  EXPECT_GT(cv::countNonZero(depth.rowRange(200, 240)), 0.98 * 40 * kSize.width);
}

constexpr double kNear_mm = 800, kFar_mm = 1600, kHalf_mm = 100;

Scene box_before_wall() {
  return world_of(
      {{Box{{kHalf_mm, kHalf_mm, kHalf_mm}}, {0, kNear_mm + kHalf_mm, 0}, Matrix3d::Identity(), 1, {1, 1, 1}},
       wall(kFar_mm)});
}

TEST(Kinect, TheProjectorsShadowLiesToTheLeftWithTheWidthOfItsFormula) {
  KinectModel model;
  const SceneRender view = view_of(box_before_wall());
  model.set_view(view, kCamera);
  const cv::Mat1b shadow = model.shadow();
  // Left edge of the box in the image, and the width f * b * (1/near - 1/far) of the shadow.
  const int left = static_cast<int>(std::lround(kCamera.fx * -kHalf_mm / kNear_mm + kCamera.cx));
  const double width = kCamera.fx * 75 * (1 / kNear_mm - 1 / kFar_mm);
  for (int r = 100; r < 140; ++r) {
    EXPECT_NEAR(cv::countNonZero(shadow.row(r)), width, 1.5);
    EXPECT_EQ(cv::countNonZero(shadow.row(r).colRange(left + 1, kSize.width)), 0);
    EXPECT_EQ(shadow(r, left - 2), 255);
  }
  EXPECT_EQ(cv::countNonZero(shadow.row(20)), 0);  // above the box
  cv::Mat1f depth;
  model.sense(1, depth);
  for (int r = 100; r < 140; ++r)  // in the middle of the shadow, away from ragged edges
    for (int c = left - static_cast<int>(width) + 3; c < left - 3; ++c) ASSERT_EQ(depth(r, c), 0);
}

// The reference: a ray from each point to the projector.
bool lit(const Scene& scene, const Vector3d& point) {
  const Vector3d projector(KinectProperties{}.baseline_mm, 0, 0);
  const Vector3d start = point + 5 * (projector - point).normalized();
  for (const Part& part : scene.parts) {
    const Matrix3d to_shape = part.rotation.transpose();
    const Ray ray{to_shape * (start - part.position_mm), to_shape * (projector - start)};
    const Hit hit = std::visit([&](const auto& body) { return intersect(body, ray); }, part.shape);
    if (hit && hit.t < 1) return false;
  }
  return true;
}

TEST(Kinect, ShadowAgreesWithRaysToTheProjector) {
  Scene scene = box_before_wall();
  scene.parts.push_back({Sphere{120}, {-420, 1100, 150}, Matrix3d::Identity(), 2, {1, 1, 1}});
  scene.parts.push_back(
      {Frustum{12, 12, 900}, {380, 900, -450}, Matrix3d::Identity(), 3, {1, 1, 1}});  // a pole
  KinectModel model;
  const SceneRender view = view_of(scene);
  model.set_view(view, kCamera);
  const Pose pose = scene.camera_at(0);
  int differ = 0, dark = 0;
  for (int r = 0; r < kSize.height; ++r)
    for (int c = 0; c < kSize.width; ++c) {
      const cv::Point3d p = kCamera.point_mm(r, c, view.depth_mm(r, c));
      const bool expected_dark = !lit(scene, pose.rotation * Vector3d(p.x, p.y, p.z));
      dark += expected_dark;
      differ += expected_dark != (model.shadow()(r, c) > 0);
    }
  EXPECT_GT(dark, 1000);
  EXPECT_LT(differ, 0.15 * dark);  // the pixels at the borders of a shadow may be either
}

TEST(Kinect, TheSameKeyGivesTheSameBitsInAnyOrder) {
  KinectModel model;
  const SceneRender view = view_of(box_before_wall());
  model.set_view(view, kCamera);
  cv::Mat1f first, second, again;
  model.sense(5, first);
  model.sense(6, second);
  model.sense(5, again);
  EXPECT_EQ(cv::norm(first, again, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(first, second, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first, sensed(view, 5), cv::NORM_INF), 0);
}

TEST(Kinect, RefusesToSenseWithoutAView) {
  KinectModel model;
  cv::Mat1f depth;
  EXPECT_THROW(model.sense(1, depth), std::logic_error);
}

}  // namespace
}  // namespace saccade::scene
