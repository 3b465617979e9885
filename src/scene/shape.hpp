#pragma once

#include <variant>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace saccade::scene {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The bodies of a scene, each in a frame of its own, lengths in mm.

/// Ball about the origin.
struct Sphere {
  double radius;
};
/// Cuboid about the origin.
struct Box {
  Vector3d half;  ///< half its sides
};
/// Solid of revolution about z from z = 0 (radius `bottom`) to z = `height` (radius `top`), closed by flat
/// ends. A cylinder has top == bottom, a cone top == 0.
struct Frustum {
  double bottom, top, height;
};
/// Lower half of a hollow ball about the origin: the rim lies in z = 0, the opening faces +z.
struct Bowl {
  double outer, inner;  ///< radii, inner < outer
};

using Shape = std::variant<Sphere, Box, Frustum, Bowl>;

/// origin + t * direction; the direction need not be of unit length.
struct Ray {
  Vector3d origin, direction;
};

/// Where a ray first enters a surface: t > 0 in units of the direction, and the outward unit normal.
struct Hit {
  double t = 0;  ///< 0 = the ray misses
  Vector3d normal = Vector3d::Zero();

  explicit operator bool() const { return t > 0; }
};

/// First hit in front of the origin. The origin is outside of the shape.
Hit intersect(const Sphere& sphere, const Ray& ray);
Hit intersect(const Box& box, const Ray& ray);
Hit intersect(const Frustum& frustum, const Ray& ray);
Hit intersect(const Bowl& bowl, const Ray& ray);

/// A ball that contains the whole shape.
struct Bound {
  Vector3d centre;
  double radius;
};
Bound bound(const Shape& shape);

}  // namespace saccade::scene
