#pragma once

#include "scene/scene.hpp"

namespace saccade::scene {

/// How the camera of a scene moves. All paths are at the still camera's pose at time 0.
enum class CameraPath {
  still,
  orbit,  ///< Scene::camera_at(): a slow swing about the target
  pan,    ///< turns to the side until the target is out of view, and back
  walk,   ///< to the side and nearer, and back, with the unrest of a hand
};

constexpr double kPanPeriod_s = 8, kWalkPeriod_s = 10;

/// The camera at a time, s.
Pose camera_on(const Scene& scene, CameraPath path, double time_s);

}  // namespace saccade::scene
