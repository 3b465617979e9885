#include "table_scene.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace saccade {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double hit_box(const Thing& thing, const cv::Point3d& from, const cv::Vec3d& ray) {
  double enter = 0, leave = kNever;
  const std::array<double, 3> low = {thing.low.x, thing.low.y, thing.low.z};
  const std::array<double, 3> high = {thing.high.x, thing.high.y, thing.high.z};
  const std::array<double, 3> start = {from.x, from.y, from.z};
  for (std::size_t k = 0; k < 3; ++k) {
    const double direction = ray[static_cast<int>(k)];
    const double a = (low[k] - start[k]) / direction, b = (high[k] - start[k]) / direction;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : kNever;
}

double hit_ball(const Thing& thing, const cv::Point3d& from, const cv::Vec3d& ray) {
  const cv::Point3d middle = (thing.low + thing.high) / 2;
  const cv::Vec3d to = middle - from;
  const double along = to.dot(ray) / ray.dot(ray);
  const double root = along * along - (to.dot(to) - thing.radius * thing.radius) / ray.dot(ray);
  return root >= 0 ? along - std::sqrt(root) : kNever;
}

}  // namespace

Thing box(double x, double y, double width, double depth, double height) {
  return {{x - width / 2, y - depth / 2, 0}, {x + width / 2, y + depth / 2, height}, 0};
}

Thing ball(double x, double y, double radius) {
  return {{x - radius, y - radius, 0}, {x + radius, y + radius, 2 * radius}, radius};
}

TableScene look_at_table(const std::vector<Thing>& things, cv::Size size) {
  TableScene scene;
  scene.camera = Intrinsics::guess_for(size);
  scene.depth_mm = cv::Mat1f(size, 0.0F);
  scene.labels = cv::Mat1i(size, 0);
  scene.points_mm = cv::Mat3f(size, cv::Vec3f());
  const double tilt = 40 * CV_PI / 180;
  const cv::Point3d from(0, -750, 600);
  const cv::Vec3d right(1, 0, 0), down(0, -std::sin(tilt), -std::cos(tilt)),
      forward(0, std::cos(tilt), -std::sin(tilt));
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c) {
      const cv::Point3d unit = scene.camera.point_mm(r, c, 1);
      const cv::Vec3d ray = unit.x * right + unit.y * down + forward;  // depth along it is its parameter
      double z = kNever;
      const double table = -from.z / ray[2];
      if (table > 0 && std::abs(table * ray[0]) < 600 && table < 2000) z = table;
      for (std::size_t k = 0; k < things.size(); ++k) {
        const double hit =
            things[k].radius > 0 ? hit_ball(things[k], from, ray) : hit_box(things[k], from, ray);
        if (hit < z) z = hit, scene.labels(r, c) = static_cast<int>(k) + 1;
      }
      if (z == kNever) continue;
      scene.depth_mm(r, c) = static_cast<float>(z);
      const cv::Point3d p = scene.camera.point_mm(r, c, z);
      scene.points_mm(r, c) =
          cv::Vec3f(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
    }
  return scene;
}

cv::Mat1f hills(cv::Size size, const std::vector<std::pair<cv::Point, float>>& list) {
  cv::Mat1f map(size, 0.0F);
  for (const auto& [at, height] : list)
    for (int r = 0; r < size.height; ++r)
      for (int c = 0; c < size.width; ++c)
        map(r, c) +=
            height * std::exp(-static_cast<float>((r - at.y) * (r - at.y) + (c - at.x) * (c - at.x)) / 50);
  return map;
}

cv::Point middle_of(const cv::Mat1i& labels, int label) {
  double rows = 0, cols = 0, count = 0;
  for (int r = 0; r < labels.rows; ++r)
    for (int c = 0; c < labels.cols; ++c)
      if (labels(r, c) == label) rows += r, cols += c, count += 1;
  cv::Point best;
  double nearest = kNever;
  for (int r = 0; r < labels.rows; ++r)
    for (int c = 0; c < labels.cols; ++c) {
      const double away = std::hypot(r - rows / count, c - cols / count);
      if (labels(r, c) == label && away < nearest) nearest = away, best = {c, r};
    }
  return best;
}

}  // namespace saccade
