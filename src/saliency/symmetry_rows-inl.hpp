// The operator at the pixels of a row (section 2 of SPEC), compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_SYMMETRY_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_SYMMETRY_ROWS_INL
#undef SACCADE_SALIENCY_SYMMETRY_ROWS_INL
#else
#define SACCADE_SALIENCY_SYMMETRY_ROWS_INL
#endif

#include <algorithm>

#include "saliency/axes-inl.hpp"
#include "saliency/denormals.hpp"
#include "saliency/params.hpp"
#include "saliency/plane_score-inl.hpp"
#include "saliency/sweep-inl.hpp"
#include "saliency/window_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// The pixels of one vector as centres; lambda as SPEC 2.4 has it.
HWY_INLINE Centres centres_at(const LevelPlanes& level, const Symmetry3dParams& params, int row, int col) {
  const Intrinsics& camera = level.camera;
  const V cols = hn::Add(hn::Iota(kF, 0.0f), set(col - camera.cx));
  Centres centres{hn::Mul(cols, set(1 / camera.fx)), set((row - camera.cy) / camera.fy), set(-1.0f),
                  static_cast<float>(1 / camera.fx), static_cast<float>(1 / camera.fy)};
  if (params.length_scale == LengthScale::relative)
    centres.minus_inverse_lambda =
        hn::Mul(set(-camera.fx / (0.05 * params.kernel)), load(level.row(LevelPlanes::kInverse, row) + col));
  return centres;
}

/// Section 2 of SPEC at one vector of pixels: the best of the three planes, Eqs. (3, 13).
HWY_INLINE V symmetry_at(const LevelPlanes& level, const Symmetry3dParams& params, const Window& window,
                         int row, int col, RowScratch& scratch) {
  using S = RowStatistics;
  const auto get = [&](int value) HWY_ATTR { return hn::Load(kF, scratch.statistics.row(value) + col); };
  const Centres centres = centres_at(level, params, row, col);
  const HalfSums all{get(S::kCount),
                     get(S::kZ),
                     get(S::kZRows),
                     get(S::kZCols),
                     {get(S::kNormalX), get(S::kNormalY), get(S::kNormalZ)}};
  V best = zero();
  for (int first = 0; first < 3; first += kPlanesPerPass) {
    Vec3 gamma[kPlanesPerPass];
    for (int i = 0; i < kPlanesPerPass; ++i) {
      const int axis = S::kAxis0 + 3 * (first + i);
      gamma[i] = {get(axis), get(axis + 1), get(axis + 2)};
    }
    HalfSums front[kPlanesPerPass];
    sum_in_front<kPlanesPerPass>(level, level.at(row, col), window, centres, gamma, scratch.sweep_terms.get(),
                                 front);
    for (int i = 0; i < kPlanesPerPass; ++i)
      best = hn::Max(best, plane_score(centres, gamma[i], front[i], all));
  }
  const V usable = load(level.row(LevelPlanes::kPacked, row) + col);
  return hn::IfThenElseZero(hn::Gt(usable, zero()), best);
}

/// Columns of the vectors of row r that hold a point; the others' scores become 0.
HWY_INLINE int find_groups(LevelPlanes& level, int r, int* columns) {
  const float* packed = level.row(LevelPlanes::kPacked, r);
  float* score = level.row(LevelPlanes::kScore, r);
  int count = 0;
  for (int c = 0; c < level.width(); c += kLanes) {
    if (hn::AllFalse(kF, hn::Gt(hn::Load(kF, packed + c), zero())))
      hn::Store(zero(), kF, score + c);
    else
      columns[count++] = c;
  }
  return count;
}

/// Kernels::symmetry_rows
void symmetry_rows(LevelPlanes& level, const Symmetry3dParams& params, int begin, int end,
                   RowScratch& scratch) {
  const DenormalsAreZero denormals;
  constexpr int kTogether = 3;
  const int reach = params.kernel / 2;
  int* columns = scratch.groups.get();
  for (int r = begin; r < end; ++r) {
    slide_column_sums(level, r, reach, r == begin, scratch);
    const int groups = find_groups(level, r, columns);
    if (groups == 0) continue;
    sum_boxes(level.width(), reach, scratch);
    window_statistics(level, r, reach, scratch);
    int g = 0;
    for (; g + kTogether <= groups; g += kTogether)
      gaussian_image_axes<kTogether>(columns + g, scratch.statistics);
    for (; g < groups; ++g) gaussian_image_axes<1>(columns + g, scratch.statistics);

    const Window window{std::max(-reach, -r), std::min(reach, level.height() - 1 - r), reach};
    for (g = 0; g < groups; ++g)
      hn::Store(symmetry_at(level, params, window, r, columns[g], scratch), kF,
                level.row(LevelPlanes::kScore, r) + columns[g]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
