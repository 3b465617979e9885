#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "ui/panels/view_context.hpp"

namespace saccade {

// The mouse on a picture or a point cloud.

/// The fixation of A that is what the mark of a fixation stands for: itself or, on B's picture, that of the
/// object with its number. -1 = A has none.
[[nodiscard]] int fixation_of_a(const ViewResult& result, int index, bool is_b);

/// A click on the mark of A's fixation `index`: locks it, or frees it if it is locked.
void click_mark(ViewContext& view, int index);

/// A click on a pixel, none = beside all of them: pins the probe there, or frees it; with Shift it is the
/// other end of a distance from the pinned pixel.
void click_pixel(ViewContext& view, std::optional<cv::Point> pixel, bool is_b);

/// The tool tip of a fixation under the mouse. `followed`: a click locks it.
void explain_fixation(const Computed& computed, int index, bool followed);

}  // namespace saccade
