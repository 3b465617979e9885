#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// An organised point cloud: one point per pixel.
struct OrganisedCloud {
  cv::Mat1f depth_mm;                    ///< H x W, z of the points, 0 = no reading
  cv::Mat3b colour;                      ///< H x W, BGR; black where there is no point; empty = none
  std::optional<Intrinsics> intrinsics;  ///< fit_camera() of the points
};

/// Size of the image of an organised PCD. Throws std::runtime_error with the reason if it is not a PCD, not
/// organised (HEIGHT 1) or refused by check_image_size().
cv::Size read_pcd_size(std::span<const std::uint8_t> pcd);

/// Reads a PCD file (version 0.7 of the Point Cloud Library; DATA ascii, binary or binary_compressed) with
/// the fields x, y and z in metres in camera frame, each a float of 4 or 8 bytes, and optionally rgb or rgba,
/// 0xAARRGGBB in 4 bytes of any type; other fields are skipped. A point that is not seen (is_seen()) is no
/// reading; its colour counts. Throws std::runtime_error with the reason, also for a
/// truncated file. Memory is bounded by the sizes of the file and of the image.
OrganisedCloud read_pcd(std::span<const std::uint8_t> pcd);

}  // namespace saccade
