// The depth of each level, sections 1.1 and 1.2; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_PYRAMID_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_PYRAMID_INL
#undef SACCADE_SALIENCY_PYRAMID_INL
#else
#define SACCADE_SALIENCY_PYRAMID_INL
#endif

#include <algorithm>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"
#include "saliency/simd/simd_stages.hpp"
#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

HWY_INLINE void store_depth(VF z, float* depth, float* inverse) {
  const MF valid = hn::Gt(z, zero());
  hn::Store(z, df, depth);
  hn::Store(hn::IfThenElseZero(valid, hn::Div(set(1.0f), hn::IfThenElse(valid, z, set(1.0f)))), df, inverse);
}

/// SimdStages::load_rows
DepthRange load_rows(const cv::Mat1f& depth_mm, LevelPlanes& level, int begin, int end) {
  constexpr float kLargestMm = 65535;
  const VF eight = set(8.0f);
  VF largest = zero(), off_grid = zero();
  for (int r = begin; r < end; ++r) {
    float* depth = level.row(LevelPlanes::kDepth, r);
    float* inverse = level.row(LevelPlanes::kInverse, r);
    std::copy(depth_mm[r], depth_mm[r] + level.width(), depth);  // frames have no margins
    for (int c = 0; c < level.width(); c += kLanes) {
      const VF z = hn::Load(df, depth + c);
      const VF valid = hn::IfThenElseZero(hn::And(hn::Gt(z, zero()), hn::Le(z, set(kLargestMm))), z);
      largest = hn::Max(largest, valid);
      const VF eighths = hn::Mul(valid, eight);
      off_grid = hn::Max(off_grid, hn::Abs(hn::Sub(eighths, hn::Round(eighths))));
      store_depth(valid, depth + c, inverse + c);
    }
  }
  return {hn::GetLane(hn::MaxOfLanes(df, largest)), hn::GetLane(hn::MaxOfLanes(df, off_grid)) == 0};
}

/// Position i of n, reflected at the ends without repeating them; n >= 3, i beyond by at most 2.
inline int reflect(int i, int n) { return i < 0 ? -i : i < n ? i : 2 * (n - 1) - i; }

/// The five rows under the binomial filter and their weights.
struct BinomialRows {
  const float* rows[5];
  static constexpr double kWeights[5] = {1, 4, 6, 4, 1};
};

/// Vertical half of the filter: sums of weighted depths and of weights, with even and odd columns separated.
/// All sums are exact in double, so the order of summation does not matter.
HWY_INLINE void filter_columns(const BinomialRows& window, int width, RowScratch& scratch) {
  double* even_depth = scratch.halving[0].data();
  double* odd_depth = scratch.halving[1].data();
  double* even_weight = scratch.halving[2].data();
  double* odd_weight = scratch.halving[3].data();
  for (int i = 0; 2 * i < width; i += kDoubleLanes) {
    VD sums[4] = {hn::Zero(dd), hn::Zero(dd), hn::Zero(dd), hn::Zero(dd)};
    for (int v = 0; v < 5; ++v) {
      hn::Vec<DHF> even, odd;
      hn::LoadInterleaved2(dhf, window.rows[v] + 2 * i, even, odd);
      const VD weight = hn::Set(dd, BinomialRows::kWeights[v]);
      const VD z0 = hn::PromoteTo(dd, even), z1 = hn::PromoteTo(dd, odd);
      sums[0] = hn::MulAdd(weight, z0, sums[0]);
      sums[1] = hn::MulAdd(weight, z1, sums[1]);
      sums[2] = hn::Add(sums[2], hn::IfThenElseZero(hn::Gt(z0, hn::Zero(dd)), weight));
      sums[3] = hn::Add(sums[3], hn::IfThenElseZero(hn::Gt(z1, hn::Zero(dd)), weight));
    }
    hn::Store(sums[0], dd, even_depth + i);
    hn::Store(sums[1], dd, odd_depth + i);
    hn::Store(sums[2], dd, even_weight + i);
    hn::Store(sums[3], dd, odd_weight + i);
  }
}

/// Column c of a row that is stored as even and odd columns.
inline double& split_column(double* even, double* odd, int c) { return c & 1 ? odd[c >> 1] : even[c >> 1]; }

/// Writes the reflected columns -2, -1, width and width + 1 of such a row.
inline void reflect_ends(double* even, double* odd, int width) {
  const int beyond[] = {-2, -1, width, width + 1};
  for (const int c : beyond) split_column(even, odd, c) = split_column(even, odd, reflect(c, width));
}

HWY_INLINE VD filter_row(const double* even, const double* odd) {
  const VD ends = hn::Add(hn::LoadU(dd, even - 1), hn::LoadU(dd, even + 1));
  const VD sides = hn::Add(hn::LoadU(dd, odd - 1), hn::LoadU(dd, odd));
  return hn::Add(hn::MulAdd(hn::Set(dd, 4.0), sides, ends), hn::Mul(hn::Set(dd, 6.0), hn::LoadU(dd, even)));
}

/// SimdStages::halve_rows
void halve_rows(const LevelPlanes& full, LevelPlanes& half, int begin, int end, RowScratch& scratch) {
  double* even_depth = scratch.halving[0].data();
  double* odd_depth = scratch.halving[1].data();
  double* even_weight = scratch.halving[2].data();
  double* odd_weight = scratch.halving[3].data();
  const VD one = hn::Set(dd, 1.0), zeros = hn::Zero(dd);
  for (int r = begin; r < end; ++r) {
    BinomialRows window;
    for (int v = -2; v <= 2; ++v)
      window.rows[v + 2] = full.row(LevelPlanes::kDepth, reflect(2 * r + v, full.height()));
    filter_columns(window, full.width(), scratch);
    reflect_ends(even_depth, odd_depth, full.width());
    reflect_ends(even_weight, odd_weight, full.width());

    float* depth = half.row(LevelPlanes::kDepth, r);
    float* inverse = half.row(LevelPlanes::kInverse, r);
    for (int c = 0; c < half.width(); c += kDoubleLanes) {
      hn::Vec<DHF> centre, unused;
      hn::LoadInterleaved2(dhf, window.rows[2] + 2 * c, centre, unused);
      const auto valid = hn::Gt(hn::PromoteTo(dd, centre), zeros);
      const VD sum = filter_row(even_depth + c, odd_depth + c);
      const VD weight = hn::IfThenElse(valid, filter_row(even_weight + c, odd_weight + c), one);
      // Rounds halves up, as std::round does with positive numbers.
      const VD eighths = hn::Div(hn::Mul(hn::Set(dd, 8.0), sum), weight);
      const VD below = hn::Floor(eighths);
      const auto up = hn::Ge(hn::Sub(eighths, below), hn::Set(dd, 0.5));
      const VD rounded = hn::Mul(hn::Add(below, hn::IfThenElseZero(up, one)), hn::Set(dd, 0.125));
      hn::Store(hn::DemoteTo(dhf, hn::IfThenElseZero(valid, rounded)), dhf, depth + c);
    }
    for (int c = 0; c < half.width(); c += kLanes)
      store_depth(hn::Load(df, depth + c), depth + c, inverse + c);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
