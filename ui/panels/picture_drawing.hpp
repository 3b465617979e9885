#pragma once

#include <array>
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

/// What stands above a picture: the model and its kernel, of both sides where it shows their difference.
[[nodiscard]] std::string picture_title(const ViewContext& view, bool is_b);

/// The values of a pixel, from the longest text to the shortest; depth_mm 0 = no reading.
[[nodiscard]] std::array<std::string, 3> pixel_texts(cv::Point pixel, float depth_mm, float saliency);

/// The line between two compared pictures.
void draw_divider(ViewContext& view, const PictureSide& whole);

}  // namespace saccade
