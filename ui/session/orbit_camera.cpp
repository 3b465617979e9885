#include "ui/session/orbit_camera.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {
namespace {

constexpr double kSteepest = 89 * CV_PI / 180;

}  // namespace

OrbitCamera OrbitCamera::at_sensor(const Intrinsics& camera, cv::Size image, double target_mm) {
  OrbitCamera result;
  result.distance_ = std::clamp(target_mm, kNearest_mm, kFarthest_mm);
  result.target_ = {0, 0, result.distance_};
  result.half_width_ = image.width / 2.0 / camera.fx;
  result.half_height_ = image.height / 2.0 / camera.fy;
  return result;
}

cv::Vec3d OrbitCamera::forward() const {
  return {std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), std::cos(yaw_) * std::cos(pitch_)};
}

cv::Vec3d OrbitCamera::right() const { return {std::cos(yaw_), 0, -std::sin(yaw_)}; }

void OrbitCamera::orbit(cv::Point2d drag_px, cv::Size viewport) {
  const double turn = CV_PI / std::max(viewport.height, 1);
  yaw_ = std::remainder(yaw_ + drag_px.x * turn, 2 * CV_PI);
  pitch_ = std::clamp(pitch_ + drag_px.y * turn, -kSteepest, kSteepest);
}

void OrbitCamera::pan(cv::Point2d drag_px, cv::Size viewport) {
  const double mm_per_px = distance_ / focal_px(viewport);
  const cv::Vec3d down = forward().cross(right());
  target_ -= mm_per_px * (drag_px.x * right() + drag_px.y * down);
}

void OrbitCamera::zoom(double steps, cv::Point2d pointer_px, cv::Size viewport) {
  const double before = distance_;
  distance_ = std::clamp(distance_ * std::pow(0.9, steps), kNearest_mm, kFarthest_mm);
  const cv::Point2d from_middle(pointer_px.x - viewport.width / 2.0, pointer_px.y - viewport.height / 2.0);
  const cv::Vec3d down = forward().cross(right());
  target_ += (before - distance_) / focal_px(viewport) * (from_middle.x * right() + from_middle.y * down);
}

cv::Matx44d OrbitCamera::view() const {
  const cv::Vec3d f = forward(), r = right(), down = f.cross(r), eye = eye_mm();
  return {r[0],     r[1],     r[2],     -r.dot(eye),    //
          -down[0], -down[1], -down[2], down.dot(eye),  //
          -f[0],    -f[1],    -f[2],    f.dot(eye),     //
          0,        0,        0,        1};
}

double OrbitCamera::focal_px(cv::Size viewport) const {
  return std::min(std::max(viewport.width, 1) / 2.0 / half_width_,
                  std::max(viewport.height, 1) / 2.0 / half_height_);
}

cv::Matx44d OrbitCamera::projection(cv::Size viewport) const {
  const double near = nearest_shown_mm(), far = distance_ + 2 * kFarthest_mm;
  const double x = 2 * focal_px(viewport) / std::max(viewport.width, 1),
               y = 2 * focal_px(viewport) / std::max(viewport.height, 1);
  return {x,
          0,
          0,
          0,  //
          0,
          y,
          0,
          0,  //
          0,
          0,
          (near + far) / (near - far),
          2 * near * far / (near - far),  //
          0,
          0,
          -1,
          0};
}

std::optional<cv::Point2d> OrbitCamera::project(const cv::Point3d& point_mm, cv::Size viewport) const {
  const cv::Vec4d eye = view() * cv::Vec4d(point_mm.x, point_mm.y, point_mm.z, 1);
  if (-eye[2] < nearest_shown_mm()) return std::nullopt;
  const double scale = focal_px(viewport) / -eye[2];
  return cv::Point2d(viewport.width / 2.0 + scale * eye[0], viewport.height / 2.0 - scale * eye[1]);
}

}  // namespace saccade
