#pragma once

#include "saliency/params.hpp"
#include "saliency/simd/level_planes.hpp"

namespace saccade {

/// The factor of a level's map (kScore) in the master map, section 3; 1 for a map that is 0 everywhere.
float level_weight(const LevelPlanes& level, LevelNormalisation kind);

}  // namespace saccade
