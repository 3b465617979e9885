#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"

namespace saccade {

/// What the depth of some rows is like.
struct DepthRange {
  float largest_mm = 0;
  bool multiples_of_eighths = true;  ///< whether every depth is a multiple of 1/8 mm

  void include(const DepthRange& other) {
    largest_mm = std::max(largest_mm, other.largest_mm);
    multiples_of_eighths = multiples_of_eighths && other.multiples_of_eighths;
  }
};

/// The operator's parameters as symmetry_rows() needs them.
struct WindowParams {
  int reach;                        ///< h = floor(k/2), px
  std::optional<double> lambda_px;  ///< lambda = lambda_px * z/fx; none: lambda = 1 mm
};

/// The stages of the operator for rows [begin, end) of a level, compiled for one instruction set. They write
/// these rows and the scratch memory and nothing else, and a row's bits do not depend on how the rows are
/// divided among calls. src/saliency/README.md has what they compute.
struct SimdStages {
  std::string_view name;  ///< as in ModelSettings::simd: "avx512", ...
  int lanes;              ///< floats in a vector
  int runs_from_reach;    ///< windows of at least this reach need RowScratch::row_sums

  /// Depth of a frame (mm) into kDepth and kInverse of level 0. Values that are not above 0 and at most 65535
  /// mm count as no reading.
  DepthRange (*load_rows)(const cv::Mat1f& depth_mm, LevelPlanes& level, int begin, int end);

  /// The next level, section 1.2: kDepth and kInverse of `half` from kDepth of `full`, with the same bits as
  /// reference::halve() has.
  void (*halve_rows)(const LevelPlanes& full, LevelPlanes& half, int begin, int end, RowScratch& scratch);

  /// Normals, section 1.3, and from them the operator's points: kUsableInverse and kPacked.
  void (*normal_rows)(LevelPlanes& level, int begin, int end);

  /// The operator, section 2: kScore, 0..4.
  void (*symmetry_rows)(LevelPlanes& level, const WindowParams& params, int begin, int end,
                        RowScratch& scratch);

  /// One step of section 3: kScore of `fine` becomes weight * kScore + the upsampled kScore of `coarse`.
  void (*add_upsampled_rows)(LevelPlanes& fine, float weight, const LevelPlanes& coarse, int begin, int end,
                             RowScratch& scratch);
};

/// The stages for the highest instruction set that `simd` (ModelSettings::simd), the environment variable
/// SACCADE_SIMD, this build and this machine allow. Throws Error (usage) if one of the two names a set that
/// cannot run here.
const SimdStages& choose_simd_stages(const std::string& simd);

}  // namespace saccade
