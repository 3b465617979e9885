#pragma once

#include <optional>
#include <span>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// True for a point in front of the camera: finite, z above 0 and below 10 km. Metres, camera frame.
bool is_seen(const cv::Point3d& point_m);

/// The pinhole camera that took an organised cloud: `points_m` row by row, as many as `size` has pixels, in
/// metres and camera frame. Least squares over the points that are seen; std::nullopt for fewer than 100 of
/// them, or if they lie more than a pixel from their places on average.
std::optional<Intrinsics> fit_camera(std::span<const cv::Point3d> points_m, cv::Size size);

}  // namespace saccade
