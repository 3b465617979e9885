#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "ui/session/picture_view.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// Red, green, blue, opacity.
struct Rgba {
  std::uint8_t r = 255, g = 255, b = 255, a = 255;
  bool operator==(const Rgba&) const = default;
};

/// The drawings over a picture, in pixels of the panel, in the order of drawing.
struct OverlayShapes {
  struct Line {
    std::vector<cv::Point2f> points;
    bool closed = false;
    float width = 1;
    Rgba colour;
  };
  struct Mark {
    cv::Point2f centre;
    float radius = 10;
    Rgba rim;
    std::string text;
  };
  struct Ring {
    cv::Point2f centre;
    float radius = 10, width = 1;
    Rgba colour;
  };
  std::vector<Line> lines;
  std::vector<Mark> marks;  ///< filled dark, the first fixation last
  std::vector<Ring> rings;  ///< over the marks
};

/// The outlines, scan path and numbered fixations of a result that the style asks for, at their places in
/// `view`; doubtful fixations (is_doubtful) are faint. Over time, numbers are ids and each object has its
/// colour (object_colour()), faint while it may not be looked at again; in place of the scan path stands the
/// trail of the gaze, whose object has a ring. `unit` is the size of a pixel of a screen of usual
/// density.
[[nodiscard]] OverlayShapes overlay_shapes(const Computed& computed, const OverlayStyle& style,
                                           const PictureView& view, double unit);

/// The index of the fixation whose mark is under `pointer`, of the topmost one; -1 = none.
[[nodiscard]] int mark_under(const OverlayShapes& shapes, cv::Point2d pointer);

}  // namespace saccade
