#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

namespace saccade::scene {

/// Sets depth to 0 (no reading) in upright strips, like the shadows of structured light beside objects, until
/// at least `share` (0..0.9) of `depth_mm` is missing. The places depend on the key, the share and the
/// readings that were missing before.
void remove_strips(std::uint64_t key, double share, cv::Mat1f& depth_mm);

}  // namespace saccade::scene
