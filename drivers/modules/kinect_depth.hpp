#pragma once

#include <array>
#include <cstdint>

namespace saccade {

/// The factory calibration that a Kinect v1 stores; the defaults are typical values, for a library that
/// cannot read it.
struct KinectGeometry {
  double baseline_cm = 7.5;            ///< between projector and infrared camera
  double reference_distance_cm = 120;  ///< of the plane on which the stored dot pattern was taken
  double reference_pixel_cm = 0.1042;  ///< what a pixel of the 1280 wide infrared image covers on that plane
  double constant_shift = 200;         ///< quarter of the raw value that the reference plane has
};

/// Depths above are no reading, as in libfreenect.
inline constexpr int kKinectLargestDepth_mm = 10000;

/// Depth in mm of an 11-bit raw value, unrounded. The value counts the shift of the dots against the stored
/// pattern in quarters of an infrared pixel: s = raw/4 - constant_shift - 3/8. On the reference plane, at
/// distance Z0, that is a length x = s * reference_pixel. Camera, projector and a dot at distance Z make
/// similar triangles, x / baseline = (Z - Z0) / Z, hence Z = Z0 * baseline / (baseline - x). Not positive, or
/// infinite, where the rays do not meet before the camera.
double kinect_depth_mm(int raw, const KinectGeometry& geometry);

/// kinect_depth_mm() for all raw values, rounded; 0 = no reading: 2047 (which says so), and depths that are
/// not in 1..kKinectLargestDepth_mm.
std::array<std::uint16_t, 2048> kinect_depth_table(const KinectGeometry& geometry);

/// Focal length of the infrared camera, and so of depth that is not registered, in pixels at a width of 640.
double kinect_focal_px(const KinectGeometry& geometry);

/// The Kinect's clock, which counts 60 MHz in 32 bits and starts again every 71.6 s, as microseconds that do
/// not. Depth and video share it, and their frames may come in either order, by less than half a minute.
class KinectClock {
 public:
  std::uint64_t microseconds(std::uint32_t ticks);

 private:
  bool started_ = false;
  std::uint64_t total_ = 0;  // ticks
};

}  // namespace saccade
