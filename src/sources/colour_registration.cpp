#include "sources/colour_registration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

// The directions that a camera's pixels see. OpenCV inverts the model of the lens step by step; a pixel for
// which that does not converge lies outside of what the lens shows.
cv::Mat2f rays_of(const LensCamera& camera) {
  const Intrinsics& pinhole = camera.pinhole;
  const cv::Matx33d matrix(pinhole.fx, 0, pinhole.cx, 0, pinhole.fy, pinhole.cy, 0, 0, 1);
  std::vector<cv::Point2f> pixels;
  for (int row = 0; row < camera.size.height; ++row)
    for (int col = 0; col < camera.size.width; ++col)
      pixels.emplace_back(static_cast<float>(col), static_cast<float>(row));
  std::vector<cv::Point2f> rays;
  cv::undistortPoints(pixels, rays, matrix, camera.distortion, cv::noArray(), cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-7));
  return cv::Mat(rays, /*copyData=*/true).reshape(2, camera.size.height);
}

}  // namespace

cv::Point2d LensCamera::pixel(double x, double y) const {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = distortion;
  const double r2 = x * x + y * y;
  const double radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  const double bent_x = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double bent_y = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return {pinhole.fx * bent_x + pinhole.cx, pinhole.fy * bent_y + pinhole.cy};
}

double LensCamera::greatest_distortion_px() const {
  double greatest = 0;
  const auto look_at = [&](int row, int col) {
    const double x = (col - pinhole.cx) / pinhole.fx, y = (row - pinhole.cy) / pinhole.fy;
    greatest = std::max(greatest, cv::norm(pixel(x, y) - cv::Point2d(col, row)));
  };
  for (int col = 0; col < size.width; ++col) {
    look_at(0, col);
    look_at(size.height - 1, col);
  }
  for (int row = 0; row < size.height; ++row) {
    look_at(row, 0);
    look_at(row, size.width - 1);
  }
  return greatest;
}

std::string distortion_note(const LensCamera& camera) {
  return fmt::format(
      "the distortion of the depth camera's lens stays in the depth; at the border it is up to {:.0f} pixels",
      camera.greatest_distortion_px());
}

cv::Mat1f without_holes(const cv::Mat1f& depth_mm) {
  const cv::Mat valid = depth_mm > 0;
  if (depth_mm.total() <= 1 || cv::countNonZero(valid) == static_cast<int>(depth_mm.total()))
    return depth_mm.clone();
  // Each pixel of half the size is the mean of the readings among its own; what is still missing there comes
  // from yet smaller sizes.
  const cv::Size half((depth_mm.cols + 1) / 2, (depth_mm.rows + 1) / 2);
  cv::Mat1f weight, sum;
  valid.convertTo(weight, CV_32F, 1.0 / 255);
  cv::resize(depth_mm, sum, half, 0, 0, cv::INTER_AREA);
  cv::resize(weight, weight, half, 0, 0, cv::INTER_AREA);
  cv::Mat1f smaller;
  cv::divide(sum, weight, smaller);
  smaller.setTo(0, weight <= 0);
  cv::Mat1f filled;
  cv::resize(without_holes(smaller), filled, depth_mm.size(), 0, 0, cv::INTER_LINEAR);
  depth_mm.copyTo(filled, valid);
  return filled;
}

ColourRegistration::ColourRegistration(const LensCamera& depth, const LensCamera& colour,
                                       const cv::Matx33d& rotation, const cv::Vec3d& translation_mm)
    : colour_(colour), rotation_(rotation), translation_mm_(translation_mm), rays_(rays_of(depth)) {}

// Outside of the image for a point that the colour camera does not see. The model of a lens holds in its
// view only: far outside, it can lead back into the image.
cv::Point2f ColourRegistration::place_of(cv::Point2f ray, double depth_mm) const {
  const cv::Point2f kNowhere(-10, -10);
  constexpr double kMargin = 0.25;  // by which a lens may widen the view, of the image's size
  const cv::Vec3d point = rotation_ * (depth_mm * cv::Vec3d(ray.x, ray.y, 1)) + translation_mm_;
  if (!(point[2] > 0)) return kNowhere;
  const double x = point[0] / point[2], y = point[1] / point[2];
  const auto inside = [](double value, int size) {
    return value > -kMargin * size && value < (1 + kMargin) * size;
  };
  const Intrinsics& pinhole = colour_.pinhole;
  if (!inside(pinhole.fx * x + pinhole.cx, colour_.size.width) ||
      !inside(pinhole.fy * y + pinhole.cy, colour_.size.height))
    return kNowhere;
  return colour_.pixel(x, y);
}

void ColourRegistration::apply(const cv::Mat1f& depth_mm, const cv::Mat3b& colour, cv::Mat3b& registered) {
  if (depth_mm.size() != rays_.size() || colour.size() != colour_.size)
    throw std::invalid_argument("ColourRegistration::apply: sizes of other cameras");
  const cv::Mat1f depth = without_holes(depth_mm);
  places_.create(depth.size());
  for (int row = 0; row < depth.rows; ++row)
    for (int col = 0; col < depth.cols; ++col) places_(row, col) = place_of(rays_(row, col), depth(row, col));
  cv::remap(colour, registered, places_, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
}

}  // namespace saccade
