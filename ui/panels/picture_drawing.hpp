#pragma once

#include <optional>
#include <string>

#include <imgui.h>

#include "output/colour_map.hpp"
#include "ui/panels/view_context.hpp"
#include "ui/session/picture_view.hpp"

namespace saccade {

/// One picture on the screen.
struct PictureSide {
  ImVec2 corner, size;         ///< of the area to which the picture's coordinates refer
  ImVec2 clip_low, clip_high;  ///< of the visible part of it
  float strip = 0;             ///< height of the strips above and below it, for title, values and legends
  bool is_b = false;
};

/// Draws everything over a picture besides the map into ImGui's current window: outlines, scan path and
/// fixations, the other panels' drawings; and beside it title, legends, and the values under the mouse.
/// `depth_range`: of the depth's colours; none = the picture does not show depth.
void draw_over_picture(ViewContext& view, const PictureSide& side, const PictureView& picture,
                       std::optional<ValueRange> depth_range);

/// Whether the picture shows the difference of A's and B's maps, which are there and of one size.
[[nodiscard]] bool shows_difference(const ViewContext& view);

/// The line between two compared pictures.
void draw_divider(ViewContext& view, const PictureSide& whole);

}  // namespace saccade
