#pragma once

#include <cstdint>
#include <vector>

#include "core/frame.hpp"

namespace saccade {

/// The points of a frame as a binary PLY: x, y, z in mm in camera frame, if `normals` is not empty its unit
/// normals, and red, green, blue if the frame has colour, of each pixel with a reading, row by row. The
/// header names the size of the image and the camera, so that read_ply() gives the same depth and colour.
std::vector<std::uint8_t> encode_ply(const Frame& frame, const cv::Mat3f& normals = {});

/// The points as an organised, binary PCD: x, y, z in metres (NaN where there is no reading) and rgb if
/// the frame has colour, a point for each pixel.
std::vector<std::uint8_t> encode_pcd(const Frame& frame);

}  // namespace saccade
