#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/layout.hpp"

namespace saccade::scene {
namespace {

// The table top, mm; its near edge is outside the image.
constexpr double kTopHalfWidth = 700, kNear = -900, kFar = 480, kThickness = 30, kHeight = 740;
// Where objects stand, mm: narrower towards the camera, so that all are in the image of frame 0.
constexpr double kNear_y = -200, kNear_x = 240, kFar_y = 290, kFar_x = 360;
constexpr double kGap = 8;  // least distance between two objects, mm

// A circle on the table that an object stays within.
struct Place {
  double x, y, radius;
};

// An object standing on z = 0 about the z axis, and the radius of the circle it needs.
struct Piece {
  std::vector<Part> parts;
  double radius;
};

Piece box_piece(Random& random) {
  const Vector3d half{random.between(28, 75), random.between(22, 60), random.between(25, 90)};
  return {{{Box{half}, {0, 0, half.z()}, Matrix3d::Identity(), 0, {}, Texture::speckled, 0.05}},
          std::hypot(half.x(), half.y())};
}

Piece ball_piece(double radius) {
  return {{{Sphere{radius}, {0, 0, radius}, Matrix3d::Identity(), 0, {}, Texture::plain, 0.6}}, radius};
}

Piece standing_cylinder_piece(Random& random) {
  const double radius = random.between(26, 48), height = random.between(80, 190);
  return {{{Frustum{radius, radius, height},
            Vector3d::Zero(),
            Matrix3d::Identity(),
            0,
            {},
            random.chance(0.5) ? Texture::striped : Texture::plain,
            0.4}},
          radius};
}

Piece lying_cylinder_piece(Random& random) {
  const double radius = random.between(24, 42), length = random.between(120, 210);
  return {
      {{Frustum{radius, radius, length}, {0, length / 2, radius}, about_x(90), 0, {}, Texture::plain, 0.4}},
      std::hypot(radius, length / 2)};
}

Piece cone_piece(Random& random) {
  const double radius = random.between(40, 65);
  return {{{Frustum{radius, 0, random.between(100, 190)},
            Vector3d::Zero(),
            Matrix3d::Identity(),
            0,
            {},
            Texture::plain,
            0.2}},
          radius};
}

Piece bowl_piece(Random& random) {
  const double outer = random.between(55, 85);
  // The bowl stands on a foot and sinks into it a little.
  return {{{Bowl{outer, outer - 5}, {0, 0, outer + 6}, Matrix3d::Identity(), 0, {}, Texture::plain, 0.4},
           {Frustum{0.5 * outer, 0.45 * outer, 12},
            Vector3d::Zero(),
            Matrix3d::Identity(),
            0,
            {},
            Texture::plain,
            0.4}},
          outer};
}

Piece make_piece(int kind, Random& random) {
  switch (kind) {
    case 0:
      return box_piece(random);
    case 1:
      return ball_piece(random.between(32, 68));
    case 2:
      return standing_cylinder_piece(random);
    case 3:
      return cone_piece(random);
    case 4:
      return bowl_piece(random);
    default:
      return lying_cylinder_piece(random);
  }
}

// Finds a free circle on the table; false after many trials.
bool find_place(const std::vector<Place>& taken, double radius, Random& random, Place& place) {
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    // Early trials stay near the middle, so that the image is cluttered.
    const double reach = 0.7 + 0.3 * trial / kTrials;
    const double y = random.between(kNear_y, kFar_y);
    const double reach_x = kNear_x + (kFar_x - kNear_x) * (y - kNear_y) / (kFar_y - kNear_y);
    place = {reach * random.between(-reach_x, reach_x), reach * y, radius};
    const bool free = std::ranges::none_of(taken, [&](const Place& other) {
      return std::hypot(place.x - other.x, place.y - other.y) < radius + other.radius + kGap;
    });
    if (free) return true;
  }
  return false;
}

void add_surroundings(Scene& scene, Random& random) {
  const Matrix3d upright = Matrix3d::Identity();
  const double warm = random.between(0.9, 1.05);
  scene.parts.push_back({Box{{kTopHalfWidth, (kFar - kNear) / 2, kThickness / 2}},
                         {0, (kNear + kFar) / 2, -kThickness / 2},
                         upright,
                         0,
                         warm * cv::Vec3d(0.42, 0.58, 0.72),
                         Texture::planks,
                         0.05});
  for (const double x : {-1.0, 1.0})
    for (const double y : {kNear + 60, kFar - 60})
      scene.parts.push_back({Box{{25, 25, (kHeight - kThickness) / 2}},
                             {x * (kTopHalfWidth - 60), y, -(kHeight + kThickness) / 2},
                             upright,
                             0,
                             {0.3, 0.42, 0.55},
                             Texture::plain,
                             0});
  scene.parts.push_back(
      {Box{{5000, 5000, 50}}, {0, 0, -kHeight - 50}, upright, 0, {0.52, 0.53, 0.55}, Texture::speckled, 0});
  scene.parts.push_back(
      {Box{{5000, 50, 3000}}, {0, 1450, 0}, upright, 0, {0.70, 0.74, 0.75}, Texture::speckled, 0});
}

}  // namespace

void lay_out_table(Scene& scene, int objects, Random& random) {
  add_surroundings(scene, random);
  std::vector<Place> taken;
  const int first_kind = random.integer(0, 5);
  for (int label = 1; label <= objects; ++label) {
    // The kinds take turns, so that a scene shows most of them.
    Piece piece = make_piece((first_kind + label) % 6, random);
    Place place{};
    // A crowded table takes smaller and smaller balls.
    for (double radius = 60; !find_place(taken, piece.radius, random, place); radius *= 0.8)
      piece = ball_piece(radius);
    taken.push_back(place);
    const Matrix3d turn = about_z(random.between(0, 360));
    const cv::Vec3d colour = object_colour(random, label);
    for (Part& part : piece.parts) {
      part.position_mm = turn * part.position_mm + Vector3d(place.x, place.y, 0);
      part.rotation = turn * part.rotation;
      part.label = label;
      part.albedo = colour;
      scene.parts.push_back(part);
    }
  }
  constexpr double kDistance_mm = 850, kElevation = 38 * std::numbers::pi / 180;
  scene.target_mm = {0, 60, 30};
  scene.eye_mm = scene.target_mm + kDistance_mm * Vector3d(0, -std::cos(kElevation), std::sin(kElevation));
  scene.light_mm = {random.between(-1100, -500), -700, 1500};
  scene.sway_rad = 30 * std::numbers::pi / 180;
}

}  // namespace saccade::scene
