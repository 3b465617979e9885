#include "ui/session/orbit_camera.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace saccade {
namespace {

const cv::Size kViewport(800, 600);
const Intrinsics kCamera = {525, 525, 319.5, 239.5};

OrbitCamera camera() { return OrbitCamera::at_sensor(kCamera, {640, 480}, 1000); }

void expect_near(cv::Point2d a, cv::Point2d b, double limit) {
  EXPECT_NEAR(a.x, b.x, limit);
  EXPECT_NEAR(a.y, b.y, limit);
}

TEST(OrbitCamera, AtTheSensorAViewportOfTheImagesShapeShowsTheImage) {
  // Pixel (100, 200) of the image, at any depth, is at the same place of a viewport of the image's size; the
  // principal point is half a pixel from the middle.
  for (const double z : {500.0, 1000.0, 4000.0})
    expect_near(camera().project(kCamera.point_mm(100, 200, z), {640, 480}).value(), {200.5, 100.5}, 1e-9);
  EXPECT_EQ(camera().eye_mm(), cv::Vec3d());
}

TEST(OrbitCamera, AtTheSensorTheWholeImageIsInSightInAViewportOfAnyShape) {
  for (const cv::Size viewport : {cv::Size(300, 900), cv::Size(900, 300)}) {
    const cv::Rect2d inside(-1, -1, viewport.width + 2, viewport.height + 2);
    for (const cv::Point pixel : {cv::Point(0, 0), cv::Point(639, 479)})
      EXPECT_TRUE(
          inside.contains(camera().project(kCamera.point_mm(pixel.y, pixel.x, 1000), viewport).value()));
  }
}

TEST(OrbitCamera, NearPointsFollowAnOrbitDrag) {
  OrbitCamera eye = camera();
  eye.orbit({100, 0}, kViewport);
  EXPECT_NEAR(cv::norm(eye.eye_mm() - eye.target_mm()), 1000, 1e-9) << "stays on the sphere";
  expect_near(eye.project({0, 0, 1000}, kViewport).value(), {400, 300}, 1e-9);
  EXPECT_GT(eye.project({0, 0, 900}, kViewport)->x, 400) << "before the target: to the right, as the drag";
  EXPECT_LT(eye.project({0, 0, 1100}, kViewport)->x, 400);

  eye = camera();
  eye.orbit({0, 100}, kViewport);
  EXPECT_GT(eye.project({0, 0, 900}, kViewport)->y, 300);
  EXPECT_LT(eye.eye_mm()[1], 0) << "y is down: the eye has risen";
}

TEST(OrbitCamera, DoesNotGoOverThePoles) {
  OrbitCamera eye = camera();
  eye.orbit({0, 100'000}, kViewport);
  EXPECT_LT(eye.eye_mm()[1], -990);
  EXPECT_GT(eye.project({0, 0, 1500}, kViewport).value().y, -1e9);
  EXPECT_LT(eye.project({0, 0, 1100}, kViewport)->y, 300) << "far is still up";
}

TEST(OrbitCamera, PanMovesWhatIsAtTheTargetWithThePointer) {
  OrbitCamera eye = camera();
  eye.orbit({130, -70}, kViewport);
  const cv::Vec3d before = eye.target_mm();
  eye.pan({37, -21}, kViewport);
  expect_near(eye.project(cv::Point3d(before), kViewport).value(), {437, 279}, 1e-6);
}

TEST(OrbitCamera, ZoomKeepsWhatIsUnderThePointer) {
  OrbitCamera eye = camera();
  eye.orbit({-200, 90}, kViewport);
  const cv::Point2d pointer(650, 140);
  // The point at the distance of the target under the pointer, found by moving the target there and back.
  OrbitCamera moved = eye;
  moved.pan({400 - pointer.x, 300 - pointer.y}, kViewport);
  const cv::Point3d under(moved.target_mm());
  expect_near(eye.project(under, kViewport).value(), pointer, 1e-6);
  for (const double steps : {3.0, -5.0}) {
    OrbitCamera zoomed = eye;
    zoomed.zoom(steps, pointer, kViewport);
    expect_near(zoomed.project(under, kViewport).value(), pointer, 1e-6);
    EXPECT_EQ(zoomed.distance_mm() < eye.distance_mm(), steps > 0);
  }
}

TEST(OrbitCamera, ZoomHasEnds) {
  OrbitCamera eye = camera();
  eye.zoom(1000, {0, 0}, kViewport);
  EXPECT_EQ(eye.distance_mm(), OrbitCamera::kNearest_mm);
  eye.zoom(-1000, {0, 0}, kViewport);
  EXPECT_EQ(eye.distance_mm(), OrbitCamera::kFarthest_mm);
}

TEST(OrbitCamera, MatricesSayTheSameAsProject) {
  OrbitCamera eye = camera();
  eye.orbit({77, 33}, kViewport);
  eye.zoom(2, {100, 100}, kViewport);
  const cv::Point3d point(120, -80, 1300);
  const cv::Vec4d clip = eye.projection(kViewport) * (eye.view() * cv::Vec4d(point.x, point.y, point.z, 1));
  const cv::Point2d at((clip[0] / clip[3] + 1) / 2 * kViewport.width,
                       (1 - clip[1] / clip[3]) / 2 * kViewport.height);
  expect_near(at, eye.project(point, kViewport).value(), 1e-6);
  EXPECT_LT(std::abs(clip[2] / clip[3]), 1) << "between the clip planes";
}

TEST(OrbitCamera, PointsBehindTheEyeAreNotProjected) {
  EXPECT_FALSE(camera().project({0, 0, -500}, kViewport).has_value());
  EXPECT_FALSE(camera().project({0, 0, 0}, kViewport).has_value());
}

}  // namespace
}  // namespace saccade
