#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "core/frame.hpp"
#include "ui/session/orbit_camera.hpp"

namespace saccade {

/// The pixel of a depth image whose point is seen at `pointer_px` of the viewport: of those at most
/// `reach_px` from it, the one whose point is nearest to the eye. None if there is none. Goes through all
/// pixels, so it is for clicks.
[[nodiscard]] std::optional<cv::Point> pixel_at(const OrbitCamera& camera, const Frame& frame,
                                                cv::Point2d pointer_px, cv::Size viewport, double reach_px);

}  // namespace saccade
