#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade::test {

/// A camera whose field of view is that of a Kinect, for an image of any size.
inline Intrinsics camera_for(cv::Size size) {
  const double f = 525.0 / 640 * size.width;
  return {f, f, (size.width - 1) / 2.0, (size.height - 1) / 2.0, IntrinsicsOrigin::option};
}

inline cv::Mat1d to_double(const cv::Mat1f& image) {
  cv::Mat1d result;
  image.convertTo(result, CV_64F);
  return result;
}

/// Depth of the plane n.p = offset_mm; 0 where a ray does not meet it in front of the camera.
inline cv::Mat1f plane_depth(cv::Size size, const Intrinsics& camera, cv::Vec3d n, double offset_mm) {
  cv::Mat1f depth(size, 0.0f);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const cv::Point3d ray = camera.point_mm(r, c, 1);
      const double z = offset_mm / (n[0] * ray.x + n[1] * ray.y + n[2] * ray.z);
      if (z > 0) depth(r, c) = static_cast<float>(z);
    }
  return depth;
}

/// Adds a sphere; the nearer surface stays.
inline void add_sphere(cv::Mat1f& depth, const Intrinsics& camera, cv::Point3d centre, double radius_mm) {
  for (int r = 0; r < depth.rows; ++r)
    for (int c = 0; c < depth.cols; ++c) {
      const cv::Point3d ray = camera.point_mm(r, c, 1);
      const double a = ray.dot(ray), b = ray.dot(centre),
                   q = b * b - a * (centre.dot(centre) - radius_mm * radius_mm);
      if (q <= 0) continue;
      const double z = (b - std::sqrt(q)) / a;
      if (depth(r, c) == 0 || z < static_cast<double>(depth(r, c))) depth(r, c) = static_cast<float>(z);
    }
}

/// Two planes that meet in a vertical edge at x = 0: z = edge_mm + slope * |x|. A positive slope is a convex
/// ridge, a negative one a concave valley.
inline cv::Mat1f ridge_depth(cv::Size size, const Intrinsics& camera, double edge_mm, double slope) {
  cv::Mat1f depth(size);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const double x = std::abs(camera.point_mm(r, c, 1).x);
      depth(r, c) = static_cast<float>(edge_mm / (1 - slope * x));  // |x| here is per mm of depth
    }
  return depth;
}

/// Noise of a structured-light sensor, readings in steps of `step_mm`, holes in clusters and alone.
inline void degrade(cv::Mat1f& depth, unsigned seed, float step_mm = 1, double holes = 0.05) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (float& z : depth) {
    if (z == 0) continue;
    const double true_mm = static_cast<double>(z);
    const double read = true_mm + 1e-6 * true_mm * true_mm * noise(random);
    z = static_cast<float>(std::round(read / static_cast<double>(step_mm))) * step_mm;
  }
  const int count = static_cast<int>(holes * static_cast<double>(depth.total()));
  for (int i = 0; i < count; ++i) {
    const int r = static_cast<int>(uniform(random) * depth.rows),
              c = static_cast<int>(uniform(random) * depth.cols);
    depth(r, c) = 0;
    if (i % 8 == 0) depth(cv::Rect(c, r, std::min(3, depth.cols - c), std::min(2, depth.rows - r))) = 0;
  }
}

/// A tilted table with two balls in front of a wall, with the noise and holes of degrade().
inline cv::Mat1f ball_scene(cv::Size size, unsigned seed = 1, float step_mm = 1) {
  const Intrinsics camera = camera_for(size);
  cv::Mat1f depth = plane_depth(size, camera, {0.2, 0, 1}, 1500);
  const cv::Mat1f table = plane_depth(size, camera, {0, 0.7, 0.7}, 800);
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c)
      if (table(r, c) > 0) depth(r, c) = std::min(depth(r, c), table(r, c));
  add_sphere(depth, camera, {-120, 40, 850}, 90);
  add_sphere(depth, camera, {150, -60, 1000}, 140);
  degrade(depth, seed, step_mm);
  return depth;
}

/// The instruction sets that this machine can run.
std::vector<std::string> runnable_simd();

}  // namespace saccade::test
