#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

namespace saccade {

/// The largest stored value that is a reading: 65535 stands for "no reading" in 16-bit depth images.
inline constexpr int kLargestStoredDepth = 65534;

inline constexpr double kMmPerMetre = 1000;

/// Stored 16-bit depth, in units of `unit_mm`, to mm: the float nearest to value * unit_mm. 0 and 65535 are
/// no reading and become 0. Overwrites `depth_mm`.
void depth_from_units(const cv::Mat1w& stored, double unit_mm, cv::Mat1f& depth_mm);

/// Depth that came as real numbers in a unit of its own: negative values, infinities and NaN become 0, which
/// is no reading; the others are multiplied by `mm_per_unit`.
void depth_from_reals(const cv::Mat1f& values, double mm_per_unit, cv::Mat1f& depth_mm);

/// What depth_to_units() could not keep.
struct DepthLosses {
  std::int64_t rounded_pixels = 0;  ///< that are no multiple of the unit
  double largest_rounding_mm = 0;
  std::int64_t out_of_range_pixels = 0;  ///< beyond 65534 units, or rounded to 0; stored as no reading

  DepthLosses& operator+=(const DepthLosses& other);
};

/// The inverse of depth_from_units(), to the nearest unit. Overwrites `stored`.
DepthLosses depth_to_units(const cv::Mat1f& depth_mm, double unit_mm, cv::Mat1w& stored);

/// A unit (mm) for 16-bit storage of depth of which no unit is known, chosen by one frame: 1 mm if all depth
/// is in whole millimetres, else the finest of 0.1, 0.2 and 1 mm that reaches a quarter beyond the farthest.
double unit_for(const cv::Mat1f& depth_mm);

/// If most readings cannot be lengths in mm of an ordinary scene (the median is below 100 mm or above 15 m),
/// or most of them are beyond 65535 mm, which nothing can use: one line that names the median and the likely
/// unit. `unit_mm`: that of the source now. std::nullopt if the depth is plausible or has no reading.
std::optional<std::string> describe_implausible_depth(const cv::Mat1f& depth_mm, double unit_mm);

}  // namespace saccade
