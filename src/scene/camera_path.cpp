#include "scene/camera_path.hpp"

#include <cmath>
#include <numbers>

#include "scene/layout.hpp"

namespace saccade::scene {
namespace {

double turns(double time_s, double period_s) { return 2 * std::numbers::pi * time_s / period_s; }

// Looks away by as much as a camera of this kind sees, and a little more.
Pose pan_at(const Scene& scene, double time_s) {
  constexpr double kFarthest_degrees = 80;
  Pose pose = scene.camera_at(0);
  const double away = (1 - std::cos(turns(time_s, kPanPeriod_s))) / 2;
  pose.rotation = about_z(kFarthest_degrees * away) * pose.rotation;
  return pose;
}

// The unrest is a sum of waves that do not meet again soon; each is 0 at time 0.
Vector3d unrest(double time_s) {
  return {std::sin(turns(time_s, 0.91)) + 0.5 * std::sin(turns(time_s, 0.37)),
          std::sin(turns(time_s, 1.13)) + 0.5 * std::sin(turns(time_s, 0.41)),
          std::sin(turns(time_s, 0.79)) + 0.5 * std::sin(turns(time_s, 0.31))};
}

Pose walk_at(const Scene& scene, double time_s) {
  constexpr double kAside = 0.3, kNearer = 0.15, kUp = 0.05;  // parts of the distance to the target
  constexpr double kHand = 0.003, kGaze = 0.008;
  const Vector3d arm = scene.eye_mm - scene.target_mm;
  const double distance = arm.norm(), phase = turns(time_s, kWalkPeriod_s);
  const Vector3d aside = arm.cross(Vector3d::UnitZ()).normalized();
  const Vector3d eye =
      scene.eye_mm + kAside * std::sin(phase) * distance * aside - kNearer * (1 - std::cos(phase)) / 2 * arm +
      kUp * std::sin(2 * phase) * distance * Vector3d::UnitZ() + kHand * distance * unrest(time_s);
  return Pose::look_at(eye, scene.target_mm + kGaze * distance * unrest(0.7 * time_s));
}

}  // namespace

Pose camera_on(const Scene& scene, CameraPath path, double time_s) {
  switch (path) {
    case CameraPath::orbit:
      return scene.camera_at(time_s);
    case CameraPath::pan:
      return pan_at(scene, time_s);
    case CameraPath::walk:
      return walk_at(scene, time_s);
    case CameraPath::still:
      break;
  }
  return scene.camera_at(0);
}

}  // namespace saccade::scene
