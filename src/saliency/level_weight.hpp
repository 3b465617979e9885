#pragma once

#include "saliency/params.hpp"
#include "saliency/simd/level_planes.hpp"

namespace saccade {

/// What the map of a level (kScore) is multiplied by before it is added to the master map, Eq. (15): 1, or
/// 1/maximum, or Itti's N(.), which lowers maps with many peaks alike: (1 - mean of the other
/// peaks)^2/maximum with peaks in units of the maximum. 1 for a map that is 0 everywhere.
float level_weight(const LevelPlanes& level, LevelNormalisation kind);

}  // namespace saccade
