#include "scene/render.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/shading.hpp"

namespace saccade::scene {
namespace {

// Pixels whose rays may touch a ball, from the tangents to its circle in the x-z and y-z planes.
struct Span {
  int begin, end;
};

Span covered(double across, double forward, double radius, double focal, double centre, int size) {
  const double square = across * across + forward * forward - radius * radius;
  if (forward + radius <= 0) return {0, 0};
  if (square <= 0 || forward <= radius) return {0, size};  // the camera is within or beside the ball
  const double tangent = radius / std::sqrt(square);
  const double slope = across / forward;
  // tan(angle -+ half opening); for a tangent behind the camera it is the image border.
  const auto edge = [&](double half, double outside) {
    const double below = 1 - slope * half;
    return below > 0 ? (slope + half) / below * focal + centre : outside;
  };
  const double low = edge(-tangent, -1.0), high = edge(tangent, size);
  return {static_cast<int>(std::clamp(std::floor(low), 0.0, static_cast<double>(size))),
          static_cast<int>(std::clamp(std::ceil(high) + 1, 0.0, static_cast<double>(size)))};
}

// Rays have z = 1 in the camera frame, so that t is the depth.
template <typename Body>
void cast(const Body& body, const Part& part, int id, const Intrinsics& camera, const Pose& pose,
          SceneRender& out) {
  const Matrix3d to_shape = part.rotation.transpose() * pose.rotation;
  const Matrix3d to_camera = to_shape.transpose();
  Ray ray;
  ray.origin = part.rotation.transpose() * (pose.position_mm - part.position_mm);
  const Bound ball = bound(part.shape);
  const Vector3d seen = to_camera * (ball.centre - ray.origin);
  const int rows = out.depth_mm.rows, cols = out.depth_mm.cols;
  const Span across = covered(seen.x(), seen.z(), ball.radius, camera.fx, camera.cx, cols);
  const Span down = covered(seen.y(), seen.z(), ball.radius, camera.fy, camera.cy, rows);
  for (int r = down.begin; r < down.end; ++r) {
    const Vector3d row_part = to_shape.col(1) * ((r - camera.cy) / camera.fy) + to_shape.col(2);
    float* depth = out.depth_mm[r];
    for (int c = across.begin; c < across.end; ++c) {
      ray.direction = row_part + to_shape.col(0) * ((c - camera.cx) / camera.fx);
      const Hit hit = intersect(body, ray);
      if (!hit || (depth[c] > 0 && static_cast<float>(hit.t) >= depth[c])) continue;
      depth[c] = static_cast<float>(hit.t);
      const Eigen::Vector3f n = (to_camera * hit.normal).cast<float>();
      out.normals(r, c) = {n.x(), n.y(), n.z()};
      out.parts(r, c) = static_cast<ushort>(id);
    }
  }
}

}  // namespace

void render(const Scene& scene, const Intrinsics& camera, cv::Size size, const Pose& pose, SceneRender& out) {
  if (!camera.valid() || size.empty()) throw std::invalid_argument("render: no such camera");
  out.depth_mm.create(size);
  out.normals.create(size);
  out.labels.create(size);
  out.parts.create(size);
  out.depth_mm.setTo(0);
  out.normals.setTo(cv::Scalar());
  out.parts.setTo(0);
  int id = 0;
  for (const Part& part : scene.parts) {
    ++id;
    std::visit([&](const auto& body) { cast(body, part, id, camera, pose, out); }, part.shape);
  }
  for (int r = 0; r < size.height; ++r)
    std::transform(out.parts[r], out.parts[r] + size.width, out.labels[r], [&](ushort part) {
      return part == 0 ? ushort{0} : static_cast<ushort>(scene.parts[part - 1u].label);
    });
  shade(scene, camera, pose, out);
}

}  // namespace saccade::scene
