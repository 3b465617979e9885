#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

enum class PcdEncoding { ascii, binary, compressed };

std::string to_string(PcdEncoding encoding);

/// An organised cloud of depth in mm with the fields x, y, z and, unless `colour` is empty, rgb as floats (as
/// the Point Cloud Library writes it); no reading = not a number.
std::vector<std::uint8_t> write_pcd(const cv::Mat1f& depth_mm, const Intrinsics& camera, PcdEncoding encoding,
                                    const cv::Mat3b& colour = {});

}  // namespace saccade
