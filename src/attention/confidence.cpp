#include "attention/confidence.hpp"

#include <algorithm>
#include <cmath>

namespace saccade {

float confidence(const ConfidenceCues& cues) {
  constexpr float kBase = 0.1F, kPerRootOfFrontShare = 3.4F, kPerLogOfSaliency = 0.37F,
                  kOnSupportingPlane = -2.4F, kWithoutSegment = 0.3F;
  constexpr float kLeastSaliency = 0.01F;  // below it a cell has next to no saliency, however little exactly
  const float log_odds =
      kBase + kPerRootOfFrontShare * std::sqrt(cues.front_share) +
      kPerLogOfSaliency * std::log(std::clamp(cues.relative_saliency, kLeastSaliency, 1.0F)) +
      (cues.on_supporting_plane ? kOnSupportingPlane : 0) + (cues.without_segment ? kWithoutSegment : 0);
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace saccade
