#pragma once

#include "scene/random.hpp"
#include "scene/scene.hpp"

/// How the scenes are put together; make_scene() is the way in.
namespace saccade::scene {

/// The look of a part.
struct Finish {
  cv::Vec3d albedo;  ///< BGR
  Texture texture = Texture::plain;
  double gloss = 0;
};

/// A rotation about the x, y or z axis of the world, degrees.
Matrix3d about_x(double degrees);
Matrix3d about_y(double degrees);
Matrix3d about_z(double degrees);

/// A well-saturated colour for one object; neighbours in `number` differ clearly in hue.
cv::Vec3d object_colour(Random& random, int number);

void lay_out_shape(Scene& scene, std::string_view name, Random& random);
void lay_out_table(Scene& scene, int objects, Random& random);
void lay_out_room(Scene& scene, Random& random);

}  // namespace saccade::scene
