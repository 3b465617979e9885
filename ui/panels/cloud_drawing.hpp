#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "ui/panels/panel_text.hpp"
#include "ui/session/cloud_vertices.hpp"
#include "ui/session/orbit_camera.hpp"

namespace saccade {

/// The viewpoint, what is pointed out, and what the user clicked.
struct CloudPanelState {
  OrbitCamera camera;
  std::optional<cv::Point3d> pinned;  ///< the point of the pinned pixel, mm
  std::vector<cv::Point3d> measured;  ///< ends of a distance, mm; empty, or two
  std::string title;                  ///< stands behind the choices; empty = none
  int highlighted = -1;               ///< index of the fixation to point out; -1 = none
  bool placed = false;                ///< false: the next frame starts from the sensor's own view
  ItemPlace title_place;              ///< set by draw_cloud(), if there is a title
  int hovered_mark = -1;              ///< set by draw_cloud(): the fixation under the pointer; -1 = none
  bool clicked = false;  ///< set by draw_cloud(): a click, without a drag, on hovered_mark or ...
  std::optional<cv::Point>
      clicked_pixel;  ///< ... else on this pixel of the depth image; none = beside all points
};

/// Draws the panel: a row of choices, and below it, in the room that is left, the cloud and the fixations.
/// Dragging with the left button orbits, with the right or middle button (or Shift) pans; the wheel zooms
/// about the pointer; a double click returns to the sensor's view; a click is reported in `state`. `render`
/// draws the cloud in the given size in pixels and returns its texture, bottom row first; 0 = none. Within an
/// ImGui window, on the drawing thread.
void draw_cloud(CloudStyle& style, CloudPanelState& state, const Frame& frame, const Attention& attention,
                const std::function<ImTextureID(cv::Size)>& render);

/// The sensor's own view of a frame; the target is at the middle of the depth range.
[[nodiscard]] OrbitCamera camera_for_frame(const Frame& frame);

}  // namespace saccade
