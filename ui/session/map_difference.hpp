#pragma once

#include <opencv2/core.hpp>

namespace saccade {

/// The difference of two maps on one scale, for display.
struct MapDifference {
  cv::Mat1f values;   ///< a - b
  float largest = 0;  ///< of their magnitudes
};

/// Throws std::invalid_argument if the sizes differ.
[[nodiscard]] MapDifference map_difference(const cv::Mat1f& a, const cv::Mat1f& b);

/// The colour of a difference, BGR: orange where A is stronger (share 0..1), blue where B is (-1..0).
[[nodiscard]] cv::Vec3b difference_colour(double share);

/// Blends the difference over a picture; the opacity grows with its magnitude. Throws std::invalid_argument
/// if the sizes differ.
void blend_difference(cv::Mat3b& picture, const MapDifference& difference, double opacity);

}  // namespace saccade
