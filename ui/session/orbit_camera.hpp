#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// The virtual camera of the point cloud: its eye orbits a target on a sphere. The world is the sensor's
/// camera frame: mm, x right, y down, z forward. Pointer positions and sizes are viewport pixels, y down.
class OrbitCamera {
 public:
  static constexpr double kNearest_mm = 50, kFarthest_mm = 50'000;

  OrbitCamera() = default;
  bool operator==(const OrbitCamera&) const = default;

  /// The sensor's own view: the eye at the sensor, the whole image visible, the target at `target_mm` ahead.
  [[nodiscard]] static OrbitCamera at_sensor(const Intrinsics& camera, cv::Size image, double target_mm);

  /// Rotates the scene with a drag: half a turn for the height of the viewport, without crossing the poles.
  void orbit(cv::Point2d drag_px, cv::Size viewport);

  /// Moves the scene with a drag; points at the distance of the target follow the pointer.
  void pan(cv::Point2d drag_px, cv::Size viewport);

  /// Moves the eye nearer (steps > 0) or away, by a tenth of the distance per step; a point at the distance
  /// of the target stays under the pointer.
  void zoom(double steps, cv::Point2d pointer_px, cv::Size viewport);

  /// Moves eye and target so that the target is at this point.
  void look_at(const cv::Vec3d& point_mm) { target_ = point_mm; }

  cv::Vec3d eye_mm() const { return target_ - distance_ * forward(); }
  cv::Vec3d target_mm() const { return target_; }
  double distance_mm() const { return distance_; }

  /// World to eye space of OpenGL: x right, y up, z towards the viewer; row by row.
  cv::Matx44d view() const;

  /// Eye space to clip space of OpenGL; row by row.
  cv::Matx44d projection(cv::Size viewport) const;

  /// The focal length in pixels: size on screen = this * size / distance.
  [[nodiscard]] double focal_px(cv::Size viewport) const;

  /// The place of a point of the world in the viewport; none if it is behind the eye.
  [[nodiscard]] std::optional<cv::Point2d> project(const cv::Point3d& point_mm, cv::Size viewport) const;

 private:
  cv::Vec3d forward() const;
  cv::Vec3d right() const;
  double nearest_shown_mm() const { return distance_ / 100; }

  cv::Vec3d target_{0, 0, 1000};
  double distance_ = 1000;
  double yaw_ = 0, pitch_ = 0;                     // rad; positive: the eye is left of, above the target
  double half_width_ = 0.61, half_height_ = 0.46;  // of what is seen, at a distance of 1
};

}  // namespace saccade
