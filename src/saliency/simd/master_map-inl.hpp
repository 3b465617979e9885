// The sum of the levels, section 3; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_MASTER_MAP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_MASTER_MAP_INL
#undef SACCADE_SALIENCY_MASTER_MAP_INL
#else
#define SACCADE_SALIENCY_MASTER_MAP_INL
#endif

#include <algorithm>

#include "saliency/simd/denormals.hpp"
#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"
#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// SimdStages::add_upsampled_rows: one step of Eq. (15). Sampling the bilinear interpolation of level l at
/// the pixels of level l - 1 and interpolating between them gives the same function. So maps can be upsampled
/// level by level, and each step is a mean of two neighbours.
void add_upsampled_rows(LevelPlanes& fine, float weight, const LevelPlanes& coarse, int begin, int end,
                        RowScratch& scratch) {
  const DenormalsAreZero denormals;
  float* line = scratch.upsampling[0].data();
  const VF half = set(0.5f);
  for (int r = begin; r < end; ++r) {
    const float* above = coarse.row(LevelPlanes::kScore, r / 2);
    const float* below = coarse.row(LevelPlanes::kScore, std::min((r + 1) / 2, coarse.height() - 1));
    for (int c = 0; c < coarse.width(); c += kLanes)
      hn::Store(hn::Mul(half, hn::Add(hn::Load(df, above + c), hn::Load(df, below + c))), df, line + c);
    line[coarse.width()] = line[coarse.width() - 1];  // clamped at the border

    float* score = fine.row(LevelPlanes::kScore, r);
    float* up = scratch.upsampling[1].data();
    for (int c = 0; c < coarse.width(); c += kLanes) {
      const VF even = hn::Load(df, line + c);
      hn::StoreInterleaved2(even, hn::Mul(half, hn::Add(even, load(line + c + 1))), df, up + 2 * c);
    }
    for (int c = 0; c < fine.width(); c += kLanes)
      hn::Store(hn::MulAdd(set(weight), hn::Load(df, score + c), hn::Load(df, up + c)), df, score + c);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
