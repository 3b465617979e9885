#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "ui/panels/view_context.hpp"

namespace saccade {

// The mouse on a picture or a point cloud.

/// A click on the mark of A's fixation `index`: locks it, or frees it if it is locked.
void click_mark(ViewContext& view, int index);

/// A click on a pixel, none = beside all of them: pins the probe there, or frees it; with Shift it is the
/// other end of a distance from the pinned pixel.
void click_pixel(ViewContext& view, std::optional<cv::Point> pixel, bool is_b);

/// The tool tip of a fixation under the mouse.
void explain_fixation(const Computed& computed, int index);

}  // namespace saccade
