#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "scene/shape.hpp"

namespace saccade::scene {

/// How the colour of a surface varies over it.
enum class Texture { plain, speckled, checked, striped, planks };

/// One body of a scene with its place and appearance. Bodies that share a label are one object.
struct Part {
  Shape shape;
  Vector3d position_mm;  ///< of the shape's frame, in the world
  Matrix3d rotation;     ///< shape to world
  int label = 0;         ///< 0 = background, 1.. = object
  cv::Vec3d albedo;      ///< BGR, 0..1
  Texture texture = Texture::plain;
  double gloss = 0;  ///< strength of the highlight, 0..1
};

/// A rigid camera pose: the camera frame (x right, y down, z forward) in the world (z up), mm.
struct Pose {
  Matrix3d rotation;  ///< camera to world; its columns are the camera's axes
  Vector3d position_mm;

  /// The pose at `eye` with `target` in the middle of the image and no roll. `eye` and `target` must not lie
  /// on one vertical line.
  static Pose look_at(const Vector3d& eye, const Vector3d& target);
};

/// A still world, a light, and the camera that looks at it. World frame: z up, the camera looks along +y.
struct Scene {
  std::string name;
  std::vector<Part> parts;
  Vector3d light_mm;   ///< position of the lamp
  Vector3d eye_mm;     ///< the camera of frame 0
  Vector3d target_mm;  ///< what it looks at, and the centre of its orbit
  double sway_rad;     ///< largest angle of a moving camera to either side
  int objects = 0;     ///< the largest label

  /// The pose of a moving camera at a time: a slow swing about the target, with a smaller rise and fall and a
  /// period of `kOrbitPeriod_s`. Time 0 is the still camera.
  Pose camera_at(double time_s) const;
};

constexpr double kOrbitPeriod_s = 8;

struct SceneOptions {
  std::uint64_t seed = 0;      ///< placement and colours
  std::optional<int> objects;  ///< number, table only, 1..kMostTableObjects; default 5..9, from the seed
  std::optional<double> distance_mm;  ///< from the camera to the target; default of each scene
};

constexpr int kMostTableObjects = 20;

/// cone, cube, cylinder, sphere, table, room.
std::span<const std::string_view> scene_names();

/// Builds a scene (README 1); the same options give the same scene. Each of the four shapes stands before a
/// plain wall, as in Fig. 3 of the paper. `table` is a table top seen at 38 degrees from above with boxes,
/// balls, cylinders, cones and bowls that do not intersect; table, wall and floor are background. `room` is a
/// furnished room: each piece of furniture is one object, flat pictures on the wall are background.
/// Throws std::invalid_argument: unknown name, `objects` out of range or for a scene other than table,
/// `distance_mm` not positive.
Scene make_scene(std::string_view name, const SceneOptions& options);

}  // namespace saccade::scene
