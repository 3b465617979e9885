#pragma once

#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"

namespace saccade {

struct OverlayStyle {
  double map_opacity = 0.8;  ///< of the most salient pixel, 0..1; less salient ones are more transparent
  bool outlines = true;      ///< of the proto-objects
  bool marks = true;         ///< numbered fixations and the scan path between them
};

/// The frame's colour image (its depth where it has none) with the map over it in turbo colours and the
/// numbered fixations. H x W, BGR. A pure function: the same input gives the same pixels.
cv::Mat3b draw_overlay(const Frame& frame, const cv::Mat1f& saliency, const Attention& attention,
                       const OverlayStyle& style = {});

}  // namespace saccade
