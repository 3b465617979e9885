#pragma once

#include <opencv2/core.hpp>

namespace saccade {

/// A map as an 8-bit gray picture for looking: 255 * sqrt(value / largest value), since a saliency map has
/// few strong and many weak pixels; all black if nothing is above 0.
cv::Mat1b to_gray(const cv::Mat1f& map);

/// A depth image as a picture for looking, BGR: near is bright, far is dark, no reading is black. The range
/// is that of the image between its 1st and 99th percentile.
cv::Mat3b depth_picture(const cv::Mat1f& depth_mm);

}  // namespace saccade
