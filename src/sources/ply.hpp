#pragma once

#include <cstdint>
#include <span>

#include <opencv2/core.hpp>

#include "sources/pcd.hpp"

namespace saccade {

/// Size of the image of a PLY cloud. Throws std::runtime_error with the reason if it is not a PLY that
/// read_ply() reads, by its header.
cv::Size read_ply_size(std::span<const std::uint8_t> ply);

/// Reads a PLY file (binary, little-endian) as Saccade writes it: points in mm, the size of the image and the
/// camera in lines "obj_info num_cols W", "obj_info num_rows H", "obj_info camera FX FY CX CY". The camera
/// leads each point back to its pixel; x, y and z must be floats of 4 or 8 bytes; red, green and blue are
/// read if each is a byte, and other properties of a vertex are skipped. Throws std::runtime_error with the
/// reason, also for a truncated file and for points outside of the image. Memory is bounded by the size of
/// the image.
OrganisedCloud read_ply(std::span<const std::uint8_t> ply);

}  // namespace saccade
