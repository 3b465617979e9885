#pragma once

#include <string_view>

#include <opencv2/core.hpp>

namespace saccade {

/// The origin of a calibration; always reported, since a wrong guess distorts every point and normal.
enum class IntrinsicsOrigin { sensor, file, option, guess };

std::string_view to_string(IntrinsicsOrigin origin);

/// Pinhole camera in pixels of level 0; (0,0) is the centre of the top-left pixel.
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  IntrinsicsOrigin origin = IntrinsicsOrigin::guess;

  /// True if all four are finite and the focal lengths are positive.
  bool valid() const;

  /// The camera of pyramid level `level`: f/2^l and c/2^l, since level l holds the even pixels of level l-1.
  Intrinsics at_level(int level) const;

  /// The point of pixel (row, col) with depth `depth_mm`, in mm, camera frame: x right, y down, z forward.
  /// Depth 0 gives (0, 0, 0), which stands for no point.
  cv::Point3d point_mm(double row, double col, double depth_mm) const {
    return {(col - cx) / fx * depth_mm, (row - cy) / fy * depth_mm, depth_mm};
  }

  /// The usual focal length of a PrimeSense camera, 525 at a width of 640, and the middle of the image.
  /// Origin: guess.
  static Intrinsics guess_for(cv::Size size);

  /// From the fields of view in radians: fx = (W/2)/tan(h/2), principal point in the middle.
  static Intrinsics from_field_of_view(cv::Size size, double horizontal_rad, double vertical_rad,
                                       IntrinsicsOrigin origin);
};

}  // namespace saccade
