#pragma once

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade::scene {

/// A camera for tests.
inline const cv::Size kSize(320, 240);
inline const Intrinsics kCamera{262.5, 262.5, 159.5, 119.5, IntrinsicsOrigin::sensor};

}  // namespace saccade::scene
