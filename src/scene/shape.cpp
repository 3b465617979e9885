#include "scene/shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace saccade::scene {
namespace {

// Roots t0 <= t1 of a*t^2 + 2*b*t + c = 0; false if there are none.
bool solve(double a, double b, double c, double& t0, double& t1) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || a == 0) return false;
  const double root = std::sqrt(discriminant);
  t0 = (-b - root) / a;
  t1 = (-b + root) / a;
  if (t0 > t1) std::swap(t0, t1);
  return true;
}

void keep_nearest(Hit& best, double t, const Vector3d& normal) {
  if (t > 0 && (!best || t < best.t)) best = {t, normal};
}

// A disc or ring in the plane z = `height`, seen from outside.
void hit_ring(Hit& best, const Ray& ray, double height, double inner, double outer, double normal_z) {
  if (ray.direction.z() * normal_z >= 0) return;
  const double t = (height - ray.origin.z()) / ray.direction.z();
  const double x = ray.origin.x() + t * ray.direction.x(), y = ray.origin.y() + t * ray.direction.y();
  const double square = x * x + y * y;
  if (square <= outer * outer && square >= inner * inner) keep_nearest(best, t, {0, 0, normal_z});
}

}  // namespace

Hit intersect(const Sphere& sphere, const Ray& ray) {
  double t0 = 0, t1 = 0;
  if (!solve(ray.direction.squaredNorm(), ray.origin.dot(ray.direction),
             ray.origin.squaredNorm() - sphere.radius * sphere.radius, t0, t1) ||
      t0 <= 0)
    return {};
  return {t0, (ray.origin + t0 * ray.direction) / sphere.radius};
}

Hit intersect(const Box& box, const Ray& ray) {
  double enter = 0, leave = HUGE_VAL;
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1 / ray.direction[i];  // +-infinity along a face: the comparisons still hold
    const double a = (-box.half[i] - ray.origin[i]) * inverse, b = (box.half[i] - ray.origin[i]) * inverse;
    if (std::min(a, b) > enter) {
      enter = std::min(a, b);
      axis = i;
    }
    leave = std::min(leave, std::max(a, b));
  }
  if (axis < 0 || enter > leave) return {};
  Hit hit{enter, Vector3d::Zero()};
  hit.normal[axis] = ray.direction[axis] > 0 ? -1 : 1;
  return hit;
}

Hit intersect(const Frustum& f, const Ray& ray) {
  // Mantle: x^2 + y^2 = (bottom + slope*z)^2.
  Hit best;
  const double slope = (f.top - f.bottom) / f.height;
  const Vector3d &o = ray.origin, &d = ray.direction;
  const double radius = f.bottom + slope * o.z(), growth = slope * d.z();
  double t0 = 0, t1 = 0;
  if (solve(d.x() * d.x() + d.y() * d.y() - growth * growth, o.x() * d.x() + o.y() * d.y() - radius * growth,
            o.x() * o.x() + o.y() * o.y() - radius * radius, t0, t1))
    for (const double t : {t0, t1}) {
      const Vector3d p = o + t * d;
      const double here = f.bottom + slope * p.z();
      if (p.z() < 0 || p.z() > f.height || here <= 0) continue;
      keep_nearest(best, t, Vector3d(p.x(), p.y(), -slope * here).normalized());
    }
  hit_ring(best, ray, 0, 0, f.bottom, -1);
  hit_ring(best, ray, f.height, 0, f.top, 1);
  return best;
}

Hit intersect(const Bowl& bowl, const Ray& ray) {
  Hit best;
  const double a = ray.direction.squaredNorm(), b = ray.origin.dot(ray.direction),
               c = ray.origin.squaredNorm();
  double t0 = 0, t1 = 0;
  const auto below_rim = [&](double t) { return ray.origin.z() + t * ray.direction.z() < 0; };
  if (solve(a, b, c - bowl.outer * bowl.outer, t0, t1) && below_rim(t0))
    keep_nearest(best, t0, (ray.origin + t0 * ray.direction) / bowl.outer);
  if (solve(a, b, c - bowl.inner * bowl.inner, t0, t1) && below_rim(t1))  // the far side, from within
    keep_nearest(best, t1, -(ray.origin + t1 * ray.direction) / bowl.inner);
  hit_ring(best, ray, 0, bowl.inner, bowl.outer, 1);
  return best;
}

Bound bound(const Shape& shape) {
  struct Visitor {
    Bound operator()(const Sphere& s) const { return {Vector3d::Zero(), s.radius}; }
    Bound operator()(const Box& b) const { return {Vector3d::Zero(), b.half.norm()}; }
    Bound operator()(const Frustum& f) const {
      return {{0, 0, f.height / 2}, std::hypot(std::max(f.bottom, f.top), f.height / 2)};
    }
    Bound operator()(const Bowl& b) const { return {Vector3d::Zero(), b.outer}; }
  };
  return std::visit(Visitor{}, shape);
}

}  // namespace saccade::scene
