#pragma once

#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// What a source knows of the scene and a sensor does not: for synthetic scenes and labelled data sets.
struct GroundTruth {
  cv::Mat1w labels;   ///< H x W, 0 = no object, 1.. = instance; empty = unknown
  cv::Mat1w classes;  ///< H x W, 0 = void (nobody labelled the pixel), 1.. = class of an object or of
                      ///< structure such as walls; empty = unknown
  cv::Mat3f normals;  ///< H x W, exact unit normals in camera frame, towards the camera, 0 = no surface;
                      ///< empty = unknown
};

/// One moment as a sensor saw it. Copying shares the pixels (cv::Mat counts references); clone() what must
/// live on, because the slots of the pipeline are filled again.
struct Frame {
  std::int64_t index = 0;  ///< position in the source, from 0; what --start and --every count
  std::int64_t timestamp_us =
      0;               ///< of the sensor or the recording; a folder without times counts 30 frames a second
  std::string name;    ///< what a person calls it, e.g. the file's name "0007"; may be empty
  cv::Mat1f depth_mm;  ///< H x W, mm along the optical axis, 0 = no reading; finite and never negative
  cv::Mat3b colour;    ///< H x W, BGR, registered to the depth; empty = none
  Intrinsics intrinsics;
  GroundTruth truth;

  cv::Size size() const { return depth_mm.size(); }
};

/// Makes `copy` the same frame with pixels of its own, in the memory that it has where that fits. The pixels
/// that `copy` had must not be shared.
void copy_frame(const Frame& frame, Frame& copy);

}  // namespace saccade
