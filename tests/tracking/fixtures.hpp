#pragma once

#include <cstdint>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// What several tests have in common: a camera of 160 x 120 pixels that does not move, and colours.
inline const Intrinsics kCamera{200, 200, 79.5, 59.5, IntrinsicsOrigin::sensor};
inline const cv::Affine3d kStill;
inline constexpr std::int64_t kSecond_us = 1'000'000;
inline const cv::Vec3b kWood(60, 90, 130), kDarkWood(40, 60, 87), kGreen(60, 140, 60), kBlack(4, 6, 9);

}  // namespace saccade
