#pragma once

#include <string>

#include <opencv2/core.hpp>

#include "models/model.hpp"

namespace saccade {

/// The settings of `model`, and levels 0..`last_level` of the 3D operator.
ModelSettings settings_for(const std::string& model, int last_level = 4);

/// A frame of this colour image with no depth at all.
Frame frame_of(const cv::Mat3b& colour);

/// The map of a frame by a fresh model.
cv::Mat1f map_of(const std::string& model, const Frame& frame, int workers = 1, int last_level = 4);

/// Random colours, smoothed a little.
cv::Mat3b noise_image(cv::Size size, int seed = 1);

/// A grid of bars on grey, all alike but one.
struct BarDisplay {
  cv::Size size = {640, 480};
  int spacing = 80;
  double angle_deg = 0, odd_angle_deg = 0;
  cv::Scalar colour = {230, 230, 230}, odd_colour = {230, 230, 230};  ///< BGR
  int odd_row = 1, odd_col = 5;                                       ///< in the grid

  cv::Mat3b draw() const;
  /// Distance of the map's maximum from the middle of the odd bar, px.
  double miss(const cv::Mat1f& map) const;
};

/// In double, times `scale`.
cv::Mat1d as_double(const cv::Mat& image, double scale = 1);

cv::Point maximum_of(const cv::Mat1f& map);

}  // namespace saccade
