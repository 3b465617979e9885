#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// Largest index of a frame that files may name; a double holds it exactly.
constexpr std::int64_t kLastFrameIndex = 1'000'000'000'000'000;

/// The truth about a scene, which synthetic scenes and labelled data sets know and sensors do not.
struct GroundTruth {
  cv::Mat1w labels;   ///< H x W, 0 = no object, 1.. = instance; empty = unknown
  cv::Mat1w classes;  ///< H x W, 0 = void (nobody labelled the pixel), 1.. = class of an object or of
                      ///< structure such as walls; empty = unknown
  cv::Mat3f normals;  ///< H x W, exact unit normals in camera frame, towards the camera, 0 = no surface;
                      ///< empty = unknown
  std::optional<cv::Affine3d> camera_to_world;  ///< mm, in a world of the source's own; none = unknown
};

/// One measurement of a sensor. Copying shares the pixels (cv::Mat counts references). Use copy_frame() to
/// keep a frame, since the pipeline fills its slots again.
struct Frame {
  std::int64_t index = 0;  ///< position in the source, from 0, as counted by --start and --every
  /// Of the sensor or the recording; a folder without times has 30 frames a second.
  std::int64_t timestamp_us = 0;
  std::string name;    ///< e.g. the file's name "0007"; may be empty
  cv::Mat1f depth_mm;  ///< H x W, mm along the optical axis, 0 = no reading; finite and never negative
  cv::Mat3b colour;    ///< H x W, BGR, registered to the depth; empty = none
  Intrinsics intrinsics;
  GroundTruth truth;

  cv::Size size() const { return depth_mm.size(); }
};

/// Makes `copy` equal to `frame`, with its own pixels; reuses its memory where the sizes fit. No other
/// cv::Mat may share the pixels of `copy`.
void copy_frame(const Frame& frame, Frame& copy);

}  // namespace saccade
