#pragma once

#include "scene/scene.hpp"

namespace saccade::scene {

/// The definition of each shape: whether a point, in the frame of the shape, lies inside.
inline bool inside(const Sphere& s, const Vector3d& p) { return p.norm() < s.radius; }
inline bool inside(const Box& b, const Vector3d& p) { return (p.cwiseAbs().array() < b.half.array()).all(); }
inline bool inside(const Frustum& f, const Vector3d& p) {
  const double radius = f.bottom + (f.top - f.bottom) * p.z() / f.height;
  return p.z() > 0 && p.z() < f.height && std::hypot(p.x(), p.y()) < radius;
}
inline bool inside(const Bowl& b, const Vector3d& p) {
  return p.z() < 0 && p.norm() < b.outer && p.norm() > b.inner;
}
inline bool inside(const Part& part, const Vector3d& world) {
  const Vector3d local = part.rotation.transpose() * (world - part.position_mm);
  return std::visit([&](const auto& body) { return inside(body, local); }, part.shape);
}

}  // namespace saccade::scene
