#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

enum class PcdEncoding { ascii, binary, compressed };

std::string to_string(PcdEncoding encoding);

/// An organised cloud of depth in mm with the fields x, y, z and rgb; no reading = not a number.
std::vector<std::uint8_t> write_pcd(const cv::Mat1f& depth_mm, const Intrinsics& camera,
                                    PcdEncoding encoding);

}  // namespace saccade
