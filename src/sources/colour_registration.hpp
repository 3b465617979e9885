#pragma once

#include <array>
#include <string>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// A camera with the distortion of its lens by the rational model of Brown and Conrady: with x, y = X/Z, Y/Z
/// and r2 = x^2 + y^2, the distorted x is x (1 + k1 r2 + k2 r2^2 + k3 r2^3) / (1 + k4 r2 + k5 r2^2 + k6 r2^3)
/// + 2 p1 x y + p2 (r2 + 2 x^2), y likewise, and the pixel is fx x + cx, fy y + cy.
struct LensCamera {
  cv::Size size;       ///< of its images
  Intrinsics pinhole;  ///< px
  /// k1, k2, p1, p2, k3, k4, k5, k6: the order of OpenCV.
  std::array<double, 8> distortion{};

  /// The pixel (column, row) in which the camera sees the direction (x, y, 1).
  cv::Point2d pixel(double x, double y) const;

  /// By how much the lens moves the pixels of the border at most, px.
  double greatest_distortion_px() const;
};

/// The note in SourceInfo of depth that such a camera took and whose distortion stays.
std::string distortion_note(const LensCamera& camera);

/// Makes an image of one camera look as if the depth camera had taken it: each depth pixel gets the colour
/// that the colour camera sees at its point. Where depth has no reading, it is interpolated for this purpose.
/// A point that another hides from the colour camera gets the colour of that other one.
class ColourRegistration {
 public:
  /// A point p of the depth camera is at `rotation` * p + `translation_mm` for the colour camera.
  ColourRegistration(const LensCamera& depth, const LensCamera& colour, const cv::Matx33d& rotation,
                     const cv::Vec3d& translation_mm);

  cv::Size colour_size() const { return colour_.size; }

  /// `depth_mm`: H x W of the depth camera, 0 = no reading; `colour`: of the colour camera's size.
  /// `registered`: H x W, black outside of the colour camera's view.
  void apply(const cv::Mat1f& depth_mm, const cv::Mat3b& colour, cv::Mat3b& registered);

 private:
  cv::Point2f place_of(cv::Point2f ray, double depth_mm) const;

  LensCamera colour_;
  cv::Matx33d rotation_;
  cv::Vec3d translation_mm_;
  cv::Mat2f rays_;    // of each depth pixel: X/Z, Y/Z
  cv::Mat2f places_;  // of each depth pixel in the colour image
};

/// Depth without holes: what is missing is interpolated from the readings around it. For the places of
/// colours only.
cv::Mat1f without_holes(const cv::Mat1f& depth_mm);

}  // namespace saccade
