// The operator at the pixels of a row, section 2; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_SYMMETRY_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_SYMMETRY_ROWS_INL
#undef SACCADE_SALIENCY_SYMMETRY_ROWS_INL
#else
#define SACCADE_SALIENCY_SYMMETRY_ROWS_INL
#endif

#include <algorithm>
#include <bit>
#include <vector>

#include "saliency/simd/axes-inl.hpp"
#include "saliency/simd/denormals.hpp"
#include "saliency/simd/plane_score-inl.hpp"
#include "saliency/simd/runs-inl.hpp"
#include "saliency/simd/simd_stages.hpp"
#include "saliency/simd/sweep-inl.hpp"
#include "saliency/simd/window_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// The pixels of one vector as centres, with lambda of section 2.4.
HWY_INLINE Centres centres_at(const LevelPlanes& level, const WindowParams& params, int row, int col) {
  const Intrinsics& camera = level.camera;
  const VF cols = hn::Add(hn::Iota(df, 0.0f), set(col - camera.cx));
  Centres centres{hn::Mul(cols, set(1 / camera.fx)), set((row - camera.cy) / camera.fy), set(-1.0f),
                  static_cast<float>(1 / camera.fx), static_cast<float>(1 / camera.fy)};
  if (params.lambda_px)
    centres.minus_inverse_lambda =
        hn::Mul(set(-camera.fx / *params.lambda_px), load(level.row(LevelPlanes::kInverse, row) + col));
  return centres;
}

/// The operator at one vector of pixels: the best of the three planes, Eq. (3), Eq. (13).
HWY_INLINE VF symmetry_at(const LevelPlanes& level, const WindowParams& params, const Window& window, int row,
                          int col, RowStatistics& statistics, const RowPrefixSums& row_sums) {
  using S = RowStatistics;
  const auto get = [&](int value) HWY_ATTR { return load(statistics.row(value) + col); };
  const Centres centres = centres_at(level, params, row, col);
  const HalfSums all{get(S::kCount),
                     get(S::kZ),
                     get(S::kZRows),
                     get(S::kZCols),
                     {get(S::kNormalX), get(S::kNormalY), get(S::kNormalZ)}};
  Vec3 gamma[kPlanes];
  for (int i = 0; i < kPlanes; ++i) {
    const int axis = S::kAxis0 + 3 * i;
    gamma[i] = {get(axis), get(axis + 1), get(axis + 2)};
  }
  HalfSums front[kPlanes];
  if (window.reach >= kRunsFromReach)
    sum_runs_in_front(level, row_sums, row, col, window, centres, gamma, front);
  else
    sum_in_front(level, level.at(row, col), window, centres, gamma, front);
  VF best = zero();
  for (int i = 0; i < kPlanes; ++i) best = hn::Max(best, plane_score(centres, gamma[i], front[i], all));
  return hn::IfThenElseZero(points_at(level, row, col), best);
}

/// Covers the points of row r with few vectors: each begins at the first point that no earlier one covers.
HWY_INLINE void find_groups(const LevelPlanes& level, int r, std::vector<int>& groups) {
  groups.clear();
  for (int c = 0; c < level.width(); c += kLanes) {
    const unsigned points = bits_of(points_at(level, r, c));
    if (points == 0) continue;
    c += std::countr_zero(points);
    groups.push_back(c);
  }
}

/// The statistics of row r. `first`: the vertical sums of row r - 1 are not there.
HWY_INLINE void prepare_row(const LevelPlanes& level, int r, int reach, bool first, RowStatistics& statistics,
                            RowScratch& scratch) {
  slide_vertical_sums(level, r, reach, first, scratch);
  find_groups(level, r, statistics.groups);
  if (statistics.groups.empty()) return;
  prefix_vertical_sums(level, reach, scratch);
  window_statistics(level, r, reach, scratch.window_sums, statistics);
  gaussian_image_axes(statistics);
}

/// SimdStages::symmetry_rows. Prepares a few rows at a time, as many as the caches hold the statistics of;
/// then goes through them column by column, so that the points of a window are still in the first-level cache
/// for the windows below it.
void symmetry_rows(LevelPlanes& level, const WindowParams& params, int begin, int end, RowScratch& scratch) {
  const DenormalsAreZero denormals;
  const int reach = params.reach;
  for (int top = begin; top < end; top += RowScratch::kPreparedRows) {
    const int bottom = std::min(top + RowScratch::kPreparedRows, end);
    if (reach >= kRunsFromReach) {
      const int first = top == begin ? std::max(0, begin - reach) : top + reach;
      for (int r = first; r < std::min(bottom + reach, level.height()); ++r)
        fill_prefix_row(level, r, reach, scratch.row_sums);
    }
    const auto statistics = [&](int r) -> RowStatistics& {
      return scratch.statistics[static_cast<std::size_t>(r - top)];
    };
    std::size_t groups = 0;
    for (int r = top; r < bottom; ++r) {
      prepare_row(level, r, reach, r == begin, statistics(r), scratch);
      groups = std::max(groups, statistics(r).groups.size());
      std::fill_n(level.row(LevelPlanes::kScore, r), level.width(), 0.0f);
    }
    for (std::size_t g = 0; g < groups; ++g)
      for (int r = top; r < bottom; ++r) {
        if (g >= statistics(r).groups.size()) continue;
        const int c = statistics(r).groups[g];
        const Window window{std::max(-reach, -r), std::min(reach, level.height() - 1 - r), reach};
        hn::StoreU(symmetry_at(level, params, window, r, c, statistics(r), scratch.row_sums), df,
                   level.row(LevelPlanes::kScore, r) + c);
      }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
