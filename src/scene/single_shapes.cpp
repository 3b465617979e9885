#include <numbers>

#include "scene/layout.hpp"

namespace saccade::scene {

// The shapes of Fig. 3 of the paper in the middle of the image, 170 to 240 px across at a width of 640. The
// wall is so far behind that no window of the operator joins the two.
void lay_out_shape(Scene& scene, std::string_view name, Random& random) {
  constexpr double kDistance_mm = 900, kWall_mm = 2200;
  const cv::Vec3d colour = object_colour(random, random.integer(0, 99));
  const Vector3d origin = Vector3d::Zero();
  if (name == "sphere")
    scene.parts.push_back({Sphere{200}, origin, Matrix3d::Identity(), 1, colour, Texture::speckled, 0.4});
  if (name == "cube")
    scene.parts.push_back(
        {Box{{105, 105, 105}}, origin, about_x(20) * about_z(40), 1, colour, Texture::speckled, 0.1});
  if (name == "cylinder") {
    const Matrix3d tilt = about_y(30) * about_x(15);
    scene.parts.push_back(
        {Frustum{80, 80, 320}, tilt * Vector3d(0, 0, -160), tilt, 1, colour, Texture::speckled, 0.3});
  }
  if (name == "cone") {
    const Matrix3d tilt = about_x(20);
    scene.parts.push_back(
        {Frustum{120, 0, 280}, tilt * Vector3d(0, 0, -125), tilt, 1, colour, Texture::speckled, 0.3});
  }
  scene.parts.push_back({Box{{6000, 100, 6000}},
                         {0, kWall_mm + 100, 0},
                         Matrix3d::Identity(),
                         0,
                         {0.66, 0.68, 0.7},
                         Texture::speckled,
                         0});
  scene.light_mm = {-900, -1500, 1400};
  scene.eye_mm = {0, -kDistance_mm, 0};
  scene.target_mm = origin;
  scene.sway_rad = 25 * std::numbers::pi / 180;
}

}  // namespace saccade::scene
