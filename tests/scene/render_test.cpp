#include "scene/render.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace saccade::scene {
namespace {

Intrinsics camera_of(cv::Size size) {
  const double focal = 525.0 * size.width / 640;
  return {focal, focal, (size.width - 1) / 2.0, (size.height - 1) / 2.0, IntrinsicsOrigin::sensor};
}

SceneRender rendered(const Scene& scene, cv::Size size, const Pose& pose) {
  SceneRender view;
  render(scene, camera_of(size), size, pose, view);
  return view;
}

Vector3d point_at(const SceneRender& view, int r, int c) {
  const cv::Point3d p = camera_of(view.depth_mm.size()).point_mm(r, c, view.depth_mm(r, c));
  return {p.x, p.y, p.z};
}

Vector3d normal_at(const SceneRender& view, int r, int c) {
  const cv::Vec3f& n = view.normals(r, c);
  return {n[0], n[1], n[2]};
}

// A world of one part, seen from `distance_mm` in front of the origin.
Scene alone(const Part& part, double distance_mm) {
  Scene scene;
  scene.parts = {part};
  scene.light_mm = {-500, -1000, 1000};
  scene.eye_mm = {0, -distance_mm, 0};
  scene.target_mm = Vector3d::Zero();
  scene.sway_rad = 0;
  scene.objects = part.label;
  return scene;
}

TEST(Render, SphereHasItsAnalyticDepthAndNormalEverywhere) {
  constexpr double kRadius = 120, kDistance = 800;
  const Scene scene =
      alone({Sphere{kRadius}, Vector3d::Zero(), Matrix3d::Identity(), 1, {1, 1, 1}}, kDistance);
  const cv::Size size(321, 241);
  const SceneRender view = rendered(scene, size, scene.camera_at(0));
  EXPECT_EQ(view.depth_mm(120, 160), static_cast<float>(kDistance - kRadius));
  int seen = 0;
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      if (view.depth_mm(r, c) == 0) continue;
      ++seen;
      const Vector3d arm = point_at(view, r, c) - Vector3d(0, 0, kDistance);
      ASSERT_NEAR(arm.norm(), kRadius, 1e-3);
      ASSERT_LT((arm / kRadius - normal_at(view, r, c)).norm(), 1e-5);
    }
  // The outline is the section of the tangent cone with the image plane.
  const double focal = camera_of(size).fx;
  const double outline = focal * kRadius / std::sqrt(kDistance * kDistance - kRadius * kRadius);
  EXPECT_NEAR(seen, std::numbers::pi * outline * outline, 4 * outline);
  EXPECT_EQ(view.depth_mm(0, 0), 0);
  EXPECT_EQ(view.normals(0, 0), cv::Vec3f());
  EXPECT_EQ(view.labels(0, 0), 0);
}

TEST(Render, TableTopIsAnExactPlane) {
  const Scene scene = make_scene("table", {4, {}, {}});
  const Pose pose = scene.camera_at(0);
  const SceneRender view = rendered(scene, {320, 240}, pose);
  int seen = 0;
  for (int r = 0; r < 240; ++r)
    for (int c = 0; c < 320; ++c) {
      if (view.depth_mm(r, c) == 0) continue;
      const double height = (pose.position_mm + pose.rotation * point_at(view, r, c)).z();
      if (view.labels(r, c) > 0) {
        ASSERT_GT(height, -1e-3);
      }
      if (view.parts(r, c) != 1 || normal_at(view, r, c).dot(pose.rotation.row(2).transpose()) < 0.9)
        continue;
      ++seen;
      ASSERT_NEAR(height, 0, 1e-3);
    }
  EXPECT_GT(seen, 20'000);
}

// The reference: every pixel with every part.
void compare_with_brute_force(const Scene& scene, const Pose& pose) {
  const cv::Size size(160, 120);
  const Intrinsics camera = camera_of(size);
  const SceneRender view = rendered(scene, size, pose);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const Vector3d direction =
          pose.rotation * Vector3d((c - camera.cx) / camera.fx, (r - camera.cy) / camera.fy, 1);
      Hit nearest;
      const Part* owner = nullptr;
      for (const Part& part : scene.parts) {
        const Matrix3d to_shape = part.rotation.transpose();
        const Ray ray{to_shape * (pose.position_mm - part.position_mm), to_shape * direction};
        const Hit hit = std::visit([&](const auto& body) { return intersect(body, ray); }, part.shape);
        if (!hit || (nearest && hit.t >= nearest.t)) continue;
        nearest = {hit.t, pose.rotation.transpose() * part.rotation * hit.normal};
        owner = &part;
      }
      ASSERT_NEAR(view.depth_mm(r, c), nearest.t, 1e-3) << r << ' ' << c;
      if (owner == nullptr) continue;
      const Part& drawn = scene.parts[view.parts(r, c) - 1u];
      ASSERT_EQ(view.labels(r, c), drawn.label);
      if (&drawn == owner) {  // else two surfaces touch here
        ASSERT_LT((normal_at(view, r, c) - nearest.normal).norm(), 1e-5);
      }
    }
}

TEST(Render, SkippingPixelsThatCannotSeeAPartChangesNothing) {
  for (const std::string_view name : scene_names()) {
    SCOPED_TRACE(std::string(name));
    const Scene scene = make_scene(name, {1, {}, {}});
    compare_with_brute_force(scene, scene.camera_at(0));
    compare_with_brute_force(scene, scene.camera_at(1.7));
  }
}

TEST(Render, PartsBesideAndBehindTheCameraAreDrawnWhereTheyAreSeen) {
  const Scene scene = make_scene("room", {2, {}, {}});
  // Turned about in the middle of the room: parts lie on every side.
  for (const Vector3d& target :
       {Vector3d(1000, 700, 500), Vector3d(-300, -800, 100), Vector3d(200, 900, 1900)}) {
    const Pose pose = Pose::look_at({100, 600, 1000}, target);
    compare_with_brute_force(scene, pose);
  }
}

TEST(Render, NormalsAreUnitFaceTheCameraAndFitTheDepth) {
  for (const std::string_view name : scene_names()) {
    SCOPED_TRACE(std::string(name));
    const Scene scene = make_scene(name, {3, {}, {}});
    const cv::Size size(320, 240);
    const SceneRender view = rendered(scene, size, scene.camera_at(0));
    int compared = 0;
    for (int r = 1; r + 1 < size.height; ++r)
      for (int c = 1; c + 1 < size.width; ++c) {
        const Vector3d n = normal_at(view, r, c);
        ASSERT_NEAR(n.norm(), 1, 1e-5);
        ASSERT_LT(n.dot(point_at(view, r, c)), 1e-3);
        bool smooth = true;
        for (const auto& [dr, dc] : {std::pair{0, 1}, {0, -1}, {1, 0}, {-1, 0}})
          smooth = smooth && view.parts(r + dr, c + dc) == view.parts(r, c) &&
                   normal_at(view, r + dr, c + dc).dot(n) > 0.998;
        if (!smooth || n.dot(point_at(view, r, c).normalized()) > -0.2) continue;
        const Vector3d across = point_at(view, r, c + 1) - point_at(view, r, c - 1);
        const Vector3d down = point_at(view, r + 1, c) - point_at(view, r - 1, c);
        ASSERT_GT(down.cross(across).normalized().dot(n), 0.998) << r << ' ' << c;
        ++compared;
      }
    EXPECT_GT(compared, 40'000);
  }
}

TEST(Render, ReusesTheMemoryOfAnEarlierView) {
  const Scene scene = make_scene("cube", {});
  SceneRender view = rendered(scene, {64, 48}, scene.camera_at(0));
  const auto* depth = view.depth_mm.data;
  const auto* colour = view.colour.data;
  const cv::Mat first = view.depth_mm.clone();
  render(scene, camera_of({64, 48}), {64, 48}, scene.camera_at(0), view);
  EXPECT_EQ(view.depth_mm.data, depth);
  EXPECT_EQ(view.colour.data, colour);
  EXPECT_EQ(cv::norm(first, view.depth_mm, cv::NORM_INF), 0);
}

TEST(Render, RefusesAnImpossibleCamera) {
  const Scene scene = make_scene("cube", {});
  SceneRender view;
  EXPECT_THROW(render(scene, Intrinsics{}, {64, 48}, scene.camera_at(0), view), std::invalid_argument);
  EXPECT_THROW(render(scene, camera_of({64, 48}), {0, 48}, scene.camera_at(0), view), std::invalid_argument);
}

TEST(Render, ShadowsFallAwayFromTheLamp) {
  Scene scene = alone({Sphere{100}, {0, 0, 100}, Matrix3d::Identity(), 1, {1, 1, 1}}, 1000);
  scene.parts.push_back({Box{{2000, 2000, 10}}, {0, 0, -10}, Matrix3d::Identity(), 0, {1, 1, 1}});
  scene.light_mm = {-2000, 0, 2000};
  const Pose pose = Pose::look_at({0, -1000, 800}, {0, 0, 0});
  const SceneRender view = rendered(scene, {320, 240}, pose);
  const auto brightness_at = [&](const Vector3d& world) {
    const Vector3d seen = pose.rotation.transpose() * (world - pose.position_mm);
    const Intrinsics camera = camera_of({320, 240});
    const auto& bgr = view.colour(static_cast<int>(std::lround(camera.fy * seen.y() / seen.z() + camera.cy)),
                                  static_cast<int>(std::lround(camera.fx * seen.x() / seen.z() + camera.cx)));
    return bgr[0] + bgr[1] + bgr[2];
  };
  EXPECT_LT(brightness_at({150, 0, 0}), 0.7 * brightness_at({-150, 0, 0}));
}

}  // namespace
}  // namespace saccade::scene
