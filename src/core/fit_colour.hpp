#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace saccade {

/// Fills `colour` with `image` (CV_8UC3, any order of channels) in the size of the depth; a copy if it has
/// that already. A larger image is averaged, a smaller one interpolated: the one rule of all sources.
/// `colour` must not share the pixels of `image`.
void fit_colour(const cv::Mat& image, cv::Size size, cv::Mat3b& colour);

/// The note in SourceInfo for it.
std::string fitted_colour_note(cv::Size image, cv::Size depth);

}  // namespace saccade
