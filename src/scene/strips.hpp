#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

namespace saccade::scene {

/// Takes readings away (sets them to 0) until at least `share` (0..0.9) of `depth_mm` is missing: upright
/// strips, as the shadows are that structured light leaves beside objects. Key, share and what was missing
/// before decide where.
void remove_strips(std::uint64_t key, double share, cv::Mat1f& depth_mm);

}  // namespace saccade::scene
