#include "ui/session/cloud_pick.hpp"

#include <gtest/gtest.h>

namespace saccade {
namespace {

const cv::Size kImage(64, 48), kPicture(640, 480);

Frame wall() {
  Frame frame;
  frame.depth_mm = cv::Mat1f(kImage, 1000.0F);
  frame.intrinsics = {52.5, 52.5, 31.5, 23.5};
  return frame;
}

OrbitCamera camera_of(const Frame& frame) { return OrbitCamera::at_sensor(frame.intrinsics, kImage, 1000); }

TEST(CloudPick, FindsThePixelWhosePointIsThere) {
  const Frame frame = wall();
  const OrbitCamera camera = camera_of(frame);
  for (const cv::Point pixel : {cv::Point(0, 0), cv::Point(20, 30), cv::Point(63, 47)}) {
    const auto at = camera.project(frame.intrinsics.point_mm(pixel.y, pixel.x, 1000), kPicture);
    EXPECT_EQ(pixel_at(camera, frame, *at, kPicture, 2), pixel);
  }
}

TEST(CloudPick, OfTwoPointsInALineItIsTheNearer) {
  Frame frame = wall();
  frame.depth_mm(24, 40) = 500;
  OrbitCamera camera = camera_of(frame);
  camera.orbit({40, 0}, kPicture);  // the near point is now before another part of the wall
  const auto at = camera.project(frame.intrinsics.point_mm(24, 40, 500), kPicture);
  EXPECT_EQ(pixel_at(camera, frame, *at, kPicture, 8), cv::Point(40, 24));
}

TEST(CloudPick, BesideAllPointsThereIsNone) {
  Frame frame = wall();
  EXPECT_FALSE(pixel_at(camera_of(frame), frame, {-100, 10}, kPicture, 8));
  frame.depth_mm = 0;
  EXPECT_FALSE(pixel_at(camera_of(frame), frame, {320, 240}, kPicture, 8));
}

}  // namespace
}  // namespace saccade
