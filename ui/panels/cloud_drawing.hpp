#pragma once

#include <cstdint>
#include <functional>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "ui/session/cloud_vertices.hpp"
#include "ui/session/orbit_camera.hpp"

namespace saccade {

/// From where the cloud is seen.
struct CloudPanelState {
  OrbitCamera camera;
  bool placed = false;  ///< the camera is; false = at the next frame it goes back to the sensor's own view
};

/// The panel: a row of choices, and below, as large as there is room, the cloud and the fixations. Drag with
/// the left button turns it, with the right or middle button (or Shift) moves it, the wheel zooms about the
/// pointer, a double click goes back to the sensor's view. `render` draws the cloud in the given size in
/// pixels and returns its texture, bottom row first; 0 = nothing. Within an ImGui window, on the thread that
/// draws.
void draw_cloud(CloudStyle& style, CloudPanelState& state, const Frame& frame, const Attention& attention,
                const std::function<ImTextureID(cv::Size)>& render);

/// The sensor's own view of a frame: its target is as far as the middle of what is seen.
OrbitCamera camera_for_frame(const Frame& frame);

}  // namespace saccade
