#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/frame_source.hpp"

namespace saccade {

/// The note in SourceInfo of a source of images without depth.
inline constexpr const char* kNoDepthNote =
    "it has no depth: only the models of the image work, and lengths are unknown";

/// Fills the fields that are alike for every frame of a video, images or a camera: no name, no truth.
inline void begin_frame(Frame& frame, const SourceInfo& info, std::int64_t index) {
  frame.index = index;
  frame.name.clear();
  frame.intrinsics = info.intrinsics;
  frame.truth = {};
}

/// Fills `colour` with `image` in the depth's size; a copy if it has that already.
inline void fit_colour(const cv::Mat3b& image, cv::Size size, cv::Mat3b& colour) {
  if (image.size() == size)
    image.copyTo(colour);
  else
    cv::resize(image, colour, size, 0, 0,
               image.size().area() > size.area() ? cv::INTER_AREA : cv::INTER_LINEAR);
}

/// The note in SourceInfo for it.
inline std::string fitted_colour_note(cv::Size image, cv::Size depth) {
  return fmt::format("colour of {} x {} is scaled to the depth's {} x {}", image.width, image.height,
                     depth.width, depth.height);
}

/// Depth without a reading.
inline void set_no_depth(Frame& frame, cv::Size size) {
  frame.depth_mm.create(size);
  frame.depth_mm.setTo(0);
}

}  // namespace saccade
