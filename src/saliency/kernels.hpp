#pragma once

#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "saliency/level_planes.hpp"
#include "saliency/params.hpp"
#include "saliency/row_scratch.hpp"

namespace saccade {

/// What the readings of some rows are like.
struct DepthRange {
  float largest_mm = 0;
  bool multiples_of_eighths = true;
};

/// The stages of the operator for rows [begin, end) of a level, compiled for one instruction set. They write
/// these rows and nothing else (besides the scratch memory), and a row's bits do not depend on how rows are
/// divided.
struct Kernels {
  std::string_view name;  ///< as in ModelSettings::simd: "avx512", ...
  int lanes;              ///< floats a vector
  int runs_from_reach;    ///< windows that reach so far need RowScratch::records

  /// Depth as it comes from a frame into kDepth and kInverse of level 0. What is not above 0 and at most
  /// 65535 mm counts as no reading.
  DepthRange (*load_rows)(const cv::Mat1f& depth_mm, LevelPlanes& level, int begin, int end);

  /// Rows of `half`, kDepth and kInverse, from kDepth of `full` (SPEC 1.2), to the bit as reference::halve().
  void (*halve_rows)(const LevelPlanes& full, LevelPlanes& half, int begin, int end, RowScratch& scratch);

  /// Normals (SPEC 1.3), and from them the operator's points: kUsableInverse and kPacked.
  void (*normal_rows)(LevelPlanes& level, int begin, int end);

  /// kScore: the operator of section 2 of SPEC, 0..4.
  void (*symmetry_rows)(LevelPlanes& level, const Symmetry3dParams& params, int begin, int end,
                        RowScratch& scratch);

  /// Eq. (15), one step of it: kScore of `fine` becomes weight * kScore + the upsampled kScore of `coarse`.
  void (*add_upsampled_rows)(LevelPlanes& fine, float weight, const LevelPlanes& coarse, int begin, int end,
                             RowScratch& scratch);
};

/// The best kernels that `simd` (ModelSettings::simd), the environment variable SACCADE_SIMD, this build and this
/// machine allow. Throws Error (usage) if one of the two names a set that cannot run here.
const Kernels& choose_kernels(const std::string& simd);

}  // namespace saccade
