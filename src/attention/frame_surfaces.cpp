#include "attention/frame_surfaces.hpp"

#include "attention/confidence.hpp"

namespace saccade {

void FrameSurfaces::build(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
  grid_.build(depth_mm, camera);
  segments_.grow(grid_);
  borders_.measure(grid_, segments_);
  weight_.reserve(grid_.size() / SurfaceSegments::kFewestCells);
  weight_.resize(static_cast<std::size_t>(segments_.count()));
  for (int segment = 0; segment < segments_.count(); ++segment)
    weight_[static_cast<std::size_t>(segment)] =
        (segments_.is_supporting_plane(segment) ? kSupportingPlaneWeight : 1) *
        (borders_.front_share(segment) < kFrontShare ? kBehindWeight : 1);
}

void FrameSurfaces::weigh(std::vector<float>& values) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int segment = segments_.of_cell()[i];
    if (grid_.depth_mm()[i] == 0)
      values[i] = 0;
    else if (segment != SurfaceSegments::kNone)
      values[i] *= weight_[static_cast<std::size_t>(segment)];
  }
}

float FrameSurfaces::confidence_at(int cell, float relative_saliency) const {
  const int segment = segments_.of_cell()[static_cast<std::size_t>(cell)];
  ConfidenceCues cues;
  cues.relative_saliency = relative_saliency;
  cues.without_segment = segment == SurfaceSegments::kNone;
  if (!cues.without_segment) {
    cues.front_share = borders_.front_share(segment);
    cues.on_supporting_plane = segments_.is_supporting_plane(segment);
  }
  return confidence(cues);
}

}  // namespace saccade
