#include "scene/scene.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "camera.hpp"
#include "saliency/reference.hpp"
#include "scene/random.hpp"
#include "scene/render.hpp"
#include "solid.hpp"

namespace saccade::scene {
namespace {

SceneRender still_view(const Scene& scene) {
  SceneRender view;
  render(scene, kCamera, kSize, scene.camera_at(0), view);
  return view;
}

cv::Point2d pixel_of(const Scene& scene, const Vector3d& world) {
  const Pose pose = scene.camera_at(0);
  const Vector3d p = pose.rotation.transpose() * (world - pose.position_mm);
  return {kCamera.fx * p.x() / p.z() + kCamera.cx, kCamera.fy * p.y() / p.z() + kCamera.cy};
}

// The most salient pixel by the reference operator with its defaults.
cv::Point2d most_salient(const Scene& scene) {
  const cv::Mat1d map = reference::symmetry3d(still_view(scene).depth_mm, kCamera, {}).master;
  cv::Point at;
  cv::minMaxLoc(map, nullptr, nullptr, nullptr, &at);
  return at;
}

double distance_to_line(const cv::Point2d& p, const cv::Point2d& a, const cv::Point2d& b) {
  return std::abs((b - a).cross(p - a)) / cv::norm(b - a);
}

const Part& only_object(const Scene& scene) {
  EXPECT_EQ(scene.objects, 1);
  EXPECT_EQ(scene.parts.front().label, 1);
  return scene.parts.front();
}

Vector3d to_world(const Part& part, const Vector3d& local) {
  return part.position_mm + part.rotation * local;
}

TEST(Scene, SphereIsMostSalientAtItsCentre) {
  const Scene scene = make_scene("sphere", {});
  const SceneRender view = still_view(scene);
  const cv::Rect outline = cv::boundingRect(view.labels == 1);
  EXPECT_GT(outline.width, 100);
  EXPECT_LT(cv::norm(most_salient(scene) - pixel_of(scene, only_object(scene).position_mm)),
            0.05 * outline.width);
}

TEST(Scene, CylinderAndConeAreMostSalientOnTheirAxis) {
  for (const std::string_view name : {"cylinder", "cone"}) {
    SCOPED_TRACE(std::string(name));
    const Scene scene = make_scene(name, {});
    const Part& part = only_object(scene);
    const double height = std::get<Frustum>(part.shape).height;
    const cv::Point2d from = pixel_of(scene, to_world(part, {0, 0, 0})),
                      to = pixel_of(scene, to_world(part, {0, 0, height}));
    const cv::Point2d peak = most_salient(scene);
    EXPECT_LT(distance_to_line(peak, from, to), 2.5);
    const double along = (peak - from).dot(to - from) / (to - from).dot(to - from);
    EXPECT_GT(along, 0);
    EXPECT_LT(along, 1);
  }
}

TEST(Scene, CubeIsMostSalientOnItsNearestEdge) {
  const Scene scene = make_scene("cube", {});
  const Part& part = only_object(scene);
  const Vector3d half = std::get<Box>(part.shape).half;
  // The nearest of the four edges along the shape's z.
  Vector3d corner;
  double nearest = HUGE_VAL;
  for (const double x : {-half.x(), half.x()})
    for (const double y : {-half.y(), half.y()}) {
      const double distance = (to_world(part, {x, y, 0}) - scene.eye_mm).norm();
      if (distance < nearest) nearest = distance, corner = {x, y, 0};
    }
  const Vector3d up(0, 0, half.z());
  const cv::Point2d from = pixel_of(scene, to_world(part, corner - up)),
                    to = pixel_of(scene, to_world(part, corner + up));
  const cv::Point2d peak = most_salient(scene);
  EXPECT_LT(distance_to_line(peak, from, to), 2);
  EXPECT_GT(peak.y, to.y - 2);
  EXPECT_LT(peak.y, from.y + 2);
}

TEST(Scene, TheSameOptionsGiveTheSameSceneAndOtherSeedsOthers) {
  for (const std::string_view name : scene_names()) {
    SCOPED_TRACE(std::string(name));
    const SceneRender a = still_view(make_scene(name, {5, {}, {}})),
                      b = still_view(make_scene(name, {5, {}, {}})),
                      c = still_view(make_scene(name, {6, {}, {}}));
    EXPECT_EQ(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(a.normals, b.normals, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(a.labels, b.labels, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(a.colour, b.colour, cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(a.colour, c.colour, cv::NORM_INF), 0);
  }
}

TEST(Scene, ObjectsOnTheTableDoNotIntersect) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const SceneOptions options{seed, seed < 4 ? std::nullopt : std::optional<int>(kMostTableObjects), {}};
    const Scene scene = make_scene("table", options);
    Random random(seed);
    for (const Part& a : scene.parts)
      for (const Part& b : scene.parts) {
        if (a.label == 0 || a.label == b.label) continue;
        const Bound ball = bound(a.shape);
        const Vector3d centre = to_world(a, ball.centre);
        if (b.label > 0 &&
            (centre - to_world(b, bound(b.shape).centre)).norm() > ball.radius + bound(b.shape).radius)
          continue;
        for (int i = 0; i < 500; ++i) {
          const Vector3d p = centre + ball.radius * Vector3d(random.between(-1, 1), random.between(-1, 1),
                                                             random.between(-1, 1));
          ASSERT_FALSE(inside(a, p) && inside(b, p)) << "seed " << seed << ": " << a.label << ", " << b.label;
        }
      }
  }
}

TEST(Scene, TheTableHoldsTheRequestedObjectsAllInTheImage) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scene scene = make_scene("table", {seed, {}, {}});
    EXPECT_GE(scene.objects, 5);
    EXPECT_LE(scene.objects, 9);
    const cv::Mat1w labels = still_view(scene).labels;
    for (int c = 0; c < labels.cols; ++c) {
      ASSERT_EQ(labels(0, c), 0) << "seed " << seed;
      ASSERT_EQ(labels(labels.rows - 1, c), 0) << "seed " << seed;
    }
    for (int r = 0; r < labels.rows; ++r) {
      ASSERT_EQ(labels(r, 0), 0) << "seed " << seed;
      ASSERT_EQ(labels(r, labels.cols - 1), 0) << "seed " << seed;
    }
  }
  for (const int objects : {1, 12, kMostTableObjects})
    EXPECT_EQ(make_scene("table", {3, objects, {}}).objects, objects);
}

TEST(Scene, TheRoomHasManyLabelledObjectsAndFlatPicturesAreNone) {
  const Scene scene = make_scene("room", {});
  const SceneRender view = still_view(scene);
  std::vector<int> pixels(static_cast<std::size_t>(scene.objects) + 1);
  for (const ushort label : view.labels) ++pixels[label];
  EXPECT_GE(std::ranges::count_if(pixels.begin() + 1, pixels.end(), [](int n) { return n > 50; }), 10);
  EXPECT_GT(pixels[0], 10'000);
  EXPECT_EQ(cv::countNonZero(view.depth_mm == 0), 0);  // walls all around
}

TEST(Scene, TheMovingCameraStartsAtTheStillOneSwingsAndReturns) {
  const Scene scene = make_scene("table", {});
  EXPECT_LT((scene.camera_at(0).position_mm - scene.eye_mm).norm(), 1e-9);
  EXPECT_LT((scene.camera_at(kOrbitPeriod_s).position_mm - scene.eye_mm).norm(), 1e-6);
  EXPECT_GT((scene.camera_at(kOrbitPeriod_s / 4).position_mm - scene.eye_mm).norm(), 200);
  for (double t = 0; t < kOrbitPeriod_s; t += 0.3) {
    const Pose pose = scene.camera_at(t);
    EXPECT_LT((pose.rotation.transpose() * pose.rotation - Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_GT(pose.rotation.determinant(), 0);
    const Vector3d target = pose.rotation.transpose() * (scene.target_mm - pose.position_mm);
    EXPECT_NEAR(target.x(), 0, 1e-9);  // in the middle of the image
    EXPECT_NEAR(target.y(), 0, 1e-9);
  }
}

TEST(Scene, DistanceMovesTheCameraAlongItsLineOfSight) {
  const Scene near = make_scene("table", {1, {}, 600.0}), far = make_scene("table", {1, {}, 1800.0});
  EXPECT_NEAR((near.eye_mm - near.target_mm).norm(), 600, 1e-9);
  EXPECT_LT((3 * (near.eye_mm - near.target_mm) - (far.eye_mm - far.target_mm)).norm(), 1e-9);
}

TEST(Scene, RefusesImpossibleOptions) {
  EXPECT_THROW(make_scene("kitchen", {}), std::invalid_argument);
  EXPECT_THROW(make_scene("room", {0, 5, {}}), std::invalid_argument);
  EXPECT_THROW(make_scene("table", {0, 0, {}}), std::invalid_argument);
  EXPECT_THROW(make_scene("table", {0, kMostTableObjects + 1, {}}), std::invalid_argument);
  EXPECT_THROW(make_scene("cone", {0, {}, 0.0}), std::invalid_argument);
  EXPECT_THROW(make_scene("cone", {0, {}, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace saccade::scene
