#include "scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "scene/layout.hpp"

namespace saccade::scene {
namespace {

constexpr std::array<std::string_view, 6> kNames = {"cone", "cube", "cylinder", "sphere", "table", "room"};

Matrix3d about(int axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Matrix3d rotation = Matrix3d::Identity();
  rotation(i, i) = rotation(j, j) = c;
  rotation(j, i) = s;
  rotation(i, j) = -s;
  return rotation;
}

// BGR of a hue in turns with the given saturation and value.
cv::Vec3d from_hue(double hue, double saturation, double value) {
  cv::Vec3d bgr;
  for (int i = 0; i < 3; ++i) {
    const double shifted = hue + (i + 1) / 3.0;  // blue a third of a turn on, then green, then red
    const double turn = shifted - std::floor(shifted);
    const double ramp = std::clamp(std::abs(6 * turn - 3) - 1, 0.0, 1.0);
    bgr[i] = value * (1 - saturation * (1 - ramp));
  }
  return bgr;
}

}  // namespace

Matrix3d about_x(double degrees) { return about(0, degrees); }
Matrix3d about_y(double degrees) { return about(1, degrees); }
Matrix3d about_z(double degrees) { return about(2, degrees); }

cv::Vec3d object_colour(Random& random, int number) {
  constexpr double kGoldenTurn = 0.61803398875;
  const double hue = number * kGoldenTurn + random.between(0, 0.08);
  const double saturation = random.between(0.5, 0.8), value = random.between(0.65, 0.95);
  return from_hue(hue, saturation, value);
}

Pose Pose::look_at(const Vector3d& eye, const Vector3d& target) {
  Pose pose;
  pose.position_mm = eye;
  const Vector3d forward = (target - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  pose.rotation.col(0) = right;
  pose.rotation.col(1) = forward.cross(right);  // down
  pose.rotation.col(2) = forward;
  return pose;
}

Pose Scene::camera_at(double time_s) const {
  const double phase = 2 * std::numbers::pi * time_s / kOrbitPeriod_s;
  const double turn_degrees = sway_rad * std::sin(phase) * 180 / std::numbers::pi;
  const Vector3d arm = eye_mm - target_mm;
  Vector3d swung = about_z(turn_degrees) * arm;
  swung.z() += 0.04 * arm.norm() * std::sin(2 * phase);
  return Pose::look_at(target_mm + swung, target_mm);
}

std::span<const std::string_view> scene_names() { return kNames; }

Scene make_scene(std::string_view name, const SceneOptions& options) {
  if (std::ranges::find(kNames, name) == kNames.end())
    throw std::invalid_argument("make_scene: no scene of this name");
  if (options.objects && (name != "table" || *options.objects < 1 || *options.objects > kMostTableObjects))
    throw std::invalid_argument("make_scene: number of objects");
  if (options.distance_mm && !(*options.distance_mm > 0 && std::isfinite(*options.distance_mm)))
    throw std::invalid_argument("make_scene: distance");
  Scene scene;
  scene.name = name;
  Random random(mix(options.seed, 1));
  if (name == "table")
    lay_out_table(scene, options.objects.value_or(random.integer(5, 9)), random);
  else if (name == "room")
    lay_out_room(scene, random);
  else
    lay_out_shape(scene, name, random);
  for (const Part& part : scene.parts) scene.objects = std::max(scene.objects, part.label);
  if (options.distance_mm)
    scene.eye_mm = scene.target_mm + (scene.eye_mm - scene.target_mm).normalized() * *options.distance_mm;
  return scene;
}

}  // namespace saccade::scene
