#pragma once

#include <optional>
#include <string>
#include <utility>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "saliency/probe.hpp"

namespace saccade {

/// A probed pixel, for display.
struct ProbeShown {
  Probe probe;
  Intrinsics camera;
  double saliency = 0;  ///< in the map on screen
  std::string model;    ///< of the map
  bool levels_apply =
      true;  ///< the map is the sum of the probe's levels; else they only describe the geometry
};

/// The user's choice in the panel.
struct ProbePanelState {
  int level = -1;  ///< the level whose planes are listed; -1 = the one that contributes most
};

/// The place of the image on the screen: pixel (row, col) covers a square of `scale` with its middle at
/// `origin + scale * (col + 0.5, row + 0.5)`. Drawing is clipped to clip_min..clip_max.
struct PicturePlace {
  ImVec2 origin, clip_min, clip_max;
  float scale = 1;

  ImVec2 at(double row, double col) const {
    return {origin.x + scale * (static_cast<float>(col) + 0.5F),
            origin.y + scale * (static_cast<float>(row) + 0.5F)};
  }
};

/// Draws the panel: values of the pixel, the contribution of each level to its saliency, and the three
/// candidate planes of one level. Without a probe, a hint. Within an ImGui window, on the thread that draws.
void draw_probe(const std::optional<ProbeShown>& shown, ProbePanelState& state);

/// Draws the operator's windows of all levels around the probed pixel, with their sizes, and the winning
/// plane of the listed level, on the picture.
void draw_footprints(ImDrawList& list, const ProbeShown& shown, const ProbePanelState& state,
                     const PicturePlace& place);

/// The index in probe.levels of the level that `state` chooses, or of the one that contributes most; -1 if
/// there are no levels.
[[nodiscard]] int listed_level(const Probe& probe, const ProbePanelState& state);

/// The line in which a plane through `point_mm` with normal `gamma` cuts the surface there (normal
/// `surface`), `length_mm` long: its ends in pixels (x = col). None if the plane lies in the surface, or an
/// end is behind the camera.
[[nodiscard]] std::optional<std::pair<cv::Point2d, cv::Point2d>> plane_trace(const cv::Vec3d& gamma,
                                                                             const cv::Vec3d& surface,
                                                                             const cv::Point3d& point_mm,
                                                                             double length_mm,
                                                                             const Intrinsics& camera);

}  // namespace saccade
