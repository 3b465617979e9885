#include "scene/event.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/layout.hpp"

namespace saccade::scene {
namespace {

// A ball about all parts of an object.
struct Extent {
  Vector3d centre = Vector3d::Zero();
  double radius = 0;
};

Extent extent_of(const Scene& scene, int label) {
  Extent extent;
  int parts = 0;
  const auto centre = [](const Part& part) {
    return Vector3d(part.position_mm + part.rotation * bound(part.shape).centre);
  };
  for (const Part& part : scene.parts)
    if (part.label == label) {
      extent.centre += centre(part);
      ++parts;
    }
  extent.centre /= std::max(1, parts);
  for (const Part& part : scene.parts)
    if (part.label == label)
      extent.radius =
          std::max(extent.radius, (centre(part) - extent.centre).norm() + bound(part.shape).radius);
  return extent;
}

// Of an object, as a part of its distance: the middle of the picture, and neither tiny nor a large piece of
// furniture.
bool is_seen_well(const Scene& scene, const Extent& extent) {
  constexpr double kAside = 0.4, kSmallest = 0.025, kLargest = 0.15;
  const Pose pose = scene.camera_at(0);
  const Vector3d seen = pose.rotation.transpose() * (extent.centre - pose.position_mm);
  return seen.z() > 0 && std::hypot(seen.x(), seen.y()) < kAside * seen.z() &&
         extent.radius > kSmallest * seen.z() && extent.radius < kLargest * seen.z();
}

// Whether nothing but background is where the object would be.
bool is_free(const Scene& scene, int label, const Vector3d& shift) {
  const Extent moved = extent_of(scene, label);
  for (int other = 1; other <= scene.objects; ++other) {
    if (other == label) continue;
    const Extent extent = extent_of(scene, other);
    if ((moved.centre + shift - extent.centre).norm() < moved.radius + extent.radius) return false;
  }
  return true;
}

Vector3d free_way(const Scene& scene, int label, Random& random) {
  constexpr int kWays = 16;
  const int first = random.integer(0, kWays - 1);
  for (int i = 0; i < kWays; ++i) {
    const double angle = 2 * std::numbers::pi * (first + i) / kWays;
    Vector3d shift = kMove_mm * Vector3d(std::cos(angle), std::sin(angle), 0);
    if (is_free(scene, label, shift)) return shift;
  }
  return {0, 0, kMove_mm};
}

void remove_object(Scene& scene, int label) {
  std::erase_if(scene.parts, [&](const Part& part) { return part.label == label; });
}

void move_object(Scene& scene, int label, const Vector3d& shift) {
  for (Part& part : scene.parts)
    if (part.label == label) part.position_mm += shift;
}

// A board across the line of sight of the still camera, `raised` from 0 (before the object) to 1 (above the
// picture).
void add_board(Scene& scene, int label, double raised) {
  constexpr double kWay = 0.6, kMargin = 1.4, kThickness_mm = 4;
  const Extent hidden = extent_of(scene, label);
  const Vector3d way = hidden.centre - scene.eye_mm;
  const double half = kWay * kMargin * hidden.radius;
  const Pose facing = Pose::look_at(scene.eye_mm, hidden.centre);
  const Vector3d up = -facing.rotation.col(1);
  scene.parts.push_back({Box{{half, half, kThickness_mm / 2}},
                         scene.eye_mm + kWay * way + raised * kWay * way.norm() * up,
                         facing.rotation,
                         scene.objects + 1,
                         {0.35, 0.55, 0.75},
                         Texture::speckled,
                         0});
  ++scene.objects;
}

}  // namespace

Event plan_event(const Scene& scene, EventKind kind, double at_s, std::uint64_t seed) {
  Random random(mix(seed, 5));
  std::vector<int> seen_well;
  for (int label = 1; label <= scene.objects; ++label)
    if (is_seen_well(scene, extent_of(scene, label))) seen_well.push_back(label);
  Event event{kind, at_s, 1, Vector3d::Zero()};
  if (!seen_well.empty())
    event.label =
        seen_well[static_cast<std::size_t>(random.integer(0, static_cast<int>(seen_well.size()) - 1))];
  if (kind == EventKind::move) event.shift_mm = free_way(scene, event.label, random);
  return event;
}

Scene scene_at(const Scene& scene, const Event& event, double time_s) {
  constexpr double kComes_s = 0.3;
  Scene now = scene;
  const double since = time_s - event.at_s;
  switch (event.kind) {
    case EventKind::none:
      break;
    case EventKind::move:
      move_object(now, event.label, std::clamp(since / kMove_s, 0.0, 1.0) * event.shift_mm);
      break;
    case EventKind::add:
      if (since < 0) remove_object(now, event.label);
      break;
    case EventKind::take:
      if (since >= 0) remove_object(now, event.label);
      break;
    case EventKind::hide:
      if (since < 0 || since > kHide_s + 2 * kComes_s) break;
      add_board(now, event.label,
                std::max({0.0, 1 - since / kComes_s, (since - kComes_s - kHide_s) / kComes_s}));
      break;
  }
  return now;
}

}  // namespace saccade::scene
