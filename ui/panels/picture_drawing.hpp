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
  ImVec2 corner, size;         ///< of the part of the window that the picture's coordinates refer to
  ImVec2 clip_low, clip_high;  ///< of what is seen of it
  bool is_b = false;
};

/// All that stands over a picture besides the map, into ImGui's current window: outlines, scan path and
/// fixations, the other panels' drawings, title, legends, what is under the mouse. `depth_range` is that of
/// the depth's colours; none = the picture is not of the depth. Needs no OpenGL.
void draw_over_picture(ViewContext& view, const PictureSide& side, const PictureView& picture,
                       std::optional<ValueRange> depth_range);

/// The line between two pictures that are compared.
void draw_divider(ViewContext& view, const PictureSide& whole);

}  // namespace saccade
