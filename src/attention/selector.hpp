#pragma once

#include "attention/attention.hpp"

namespace saccade {

/// What every selector does first: checks its input and empties `attention`, keeping its memory.
/// Throws std::invalid_argument if the images are empty or differ in size, or the camera is not valid.
void begin_attention(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera,
                     Attention& attention);

/// The fixation at pixel (row, col), without a proto-object.
Fixation fixation_at(const cv::Mat1f& saliency, const cv::Mat1f& depth_mm, const Intrinsics& camera, int row,
                     int col);

}  // namespace saccade
