#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "attention/border_ownership.hpp"
#include "attention/surface_grid.hpp"
#include "attention/surface_segments.hpp"

namespace saccade {

/// The surfaces of a frame: its cells, their segments, and what each segment's borders say of it. Keeps its
/// memory between frames. Thread safety: one build() at a time per object; reading is free.
class FrameSurfaces {
 public:
  /// A cell on a supporting plane counts this share of its value: coarse pyramid levels spread an object's
  /// saliency over the table before it, and a plane behind the things is no object while there are others.
  static constexpr float kSupportingPlaneWeight = 0.02F;

  /// A cell of a segment that owns less than kFrontShare of its border, because it is seen behind other
  /// things, counts kBehindWeight of its value.
  static constexpr float kFrontShare = 0.1F;
  static constexpr float kBehindWeight = 0.1F;

  /// depth_mm, camera: as SurfaceGrid::build() takes them.
  void build(const cv::Mat1f& depth_mm, const Intrinsics& camera);

  const SurfaceGrid& grid() const { return grid_; }
  const SurfaceSegments& segments() const { return segments_; }
  const BorderOwnership& borders() const { return borders_; }

  /// Weighs the values of the cells (row by row) by what the cells are: 0 where there is no depth, and the
  /// weights above.
  void weigh(std::vector<float>& values) const;

  /// confidence() of a fixation on a cell. relative_saliency: of the cell's smoothed saliency to that of the
  /// frame's first fixation, above 0.
  [[nodiscard]] float confidence_at(int cell, float relative_saliency) const;

 private:
  SurfaceGrid grid_;
  SurfaceSegments segments_;
  BorderOwnership borders_;
  std::vector<float> weight_;  // by segment
};

}  // namespace saccade
