#pragma once

#include "scene/random.hpp"
#include "scene/scene.hpp"

/// The parts of make_scene(), one function for each kind of scene.
namespace saccade::scene {

/// The appearance of a part.
struct Finish {
  cv::Vec3d albedo;  ///< BGR
  Texture texture = Texture::plain;
  double gloss = 0;
};

/// A rotation about the x, y or z axis of the world, degrees.
Matrix3d about_x(double degrees);
Matrix3d about_y(double degrees);
Matrix3d about_z(double degrees);

/// A saturated colour for one object; objects with successive `number` differ clearly in hue. BGR, 0..1.
cv::Vec3d object_colour(Random& random, int number);

/// Adds the parts, camera and lamp of a scene. `random`: at the start of the stream of the seed.
void lay_out_shape(Scene& scene, std::string_view name, Random& random);
void lay_out_table(Scene& scene, int objects, Random& random);
void lay_out_room(Scene& scene, Random& random);

}  // namespace saccade::scene
