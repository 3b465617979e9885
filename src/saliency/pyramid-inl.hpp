// The depth of each level (SPEC 1.2), compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_PYRAMID_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_PYRAMID_INL
#undef SACCADE_SALIENCY_PYRAMID_INL
#else
#define SACCADE_SALIENCY_PYRAMID_INL
#endif

#include <algorithm>

#include "saliency/kernels.hpp"
#include "saliency/level_planes.hpp"
#include "saliency/row_scratch.hpp"
#include "saliency/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

HWY_INLINE void store_depth(V z, float* depth, float* inverse) {
  const M valid = hn::Gt(z, zero());
  hn::Store(z, kF, depth);
  hn::Store(hn::IfThenElseZero(valid, hn::Div(set(1.0f), hn::IfThenElse(valid, z, set(1.0f)))), kF, inverse);
}

/// Kernels::load_rows
DepthRange load_rows(const cv::Mat1f& depth_mm, LevelPlanes& level, int begin, int end) {
  constexpr float kLargestMm = 65535;
  const V eight = set(8.0f);
  V largest = zero(), off_grid = zero();
  for (int r = begin; r < end; ++r) {
    float* depth = level.row(LevelPlanes::kDepth, r);
    float* inverse = level.row(LevelPlanes::kInverse, r);
    std::copy(depth_mm[r], depth_mm[r] + level.width(), depth);  // frames have no margins
    for (int c = 0; c < level.width(); c += kLanes) {
      const V z = hn::Load(kF, depth + c);
      const V valid = hn::IfThenElseZero(hn::And(hn::Gt(z, zero()), hn::Le(z, set(kLargestMm))), z);
      largest = hn::Max(largest, valid);
      const V eighths = hn::Mul(valid, eight);
      off_grid = hn::Max(off_grid, hn::Abs(hn::Sub(eighths, hn::Round(eighths))));
      store_depth(valid, depth + c, inverse + c);
    }
  }
  return {hn::GetLane(hn::MaxOfLanes(kF, largest)), hn::GetLane(hn::MaxOfLanes(kF, off_grid)) == 0};
}

/// Position i of n, reflected at the ends without repeating them; n >= 3, i beyond by at most 2.
inline int reflect(int i, int n) { return i < 0 ? -i : i < n ? i : 2 * (n - 1) - i; }

/// The rows of a window of the binomial and their weights.
struct BinomialRows {
  const float* rows[5];
  static constexpr double kWeights[5] = {1, 4, 6, 4, 1};
};

/// Vertical half of the filter: sums of weighted depths and of weights, even and odd columns apart. All sums
/// are exact in double, so that the order of summation does not matter.
HWY_INLINE void filter_columns(const BinomialRows& window, int width, RowScratch& scratch) {
  double* even_depth = scratch.halving[0].data();
  double* odd_depth = scratch.halving[1].data();
  double* even_weight = scratch.halving[2].data();
  double* odd_weight = scratch.halving[3].data();
  for (int i = 0; 2 * i < width; i += kWideLanes) {
    WideV sums[4] = {hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide), hn::Zero(kWide)};
    for (int v = 0; v < 5; ++v) {
      hn::Vec<HalfF> even, odd;
      hn::LoadInterleaved2(kHalfF, window.rows[v] + 2 * i, even, odd);
      const WideV weight = hn::Set(kWide, BinomialRows::kWeights[v]);
      const WideV z0 = hn::PromoteTo(kWide, even), z1 = hn::PromoteTo(kWide, odd);
      sums[0] = hn::MulAdd(weight, z0, sums[0]);
      sums[1] = hn::MulAdd(weight, z1, sums[1]);
      sums[2] = hn::Add(sums[2], hn::IfThenElseZero(hn::Gt(z0, hn::Zero(kWide)), weight));
      sums[3] = hn::Add(sums[3], hn::IfThenElseZero(hn::Gt(z1, hn::Zero(kWide)), weight));
    }
    hn::Store(sums[0], kWide, even_depth + i);
    hn::Store(sums[1], kWide, odd_depth + i);
    hn::Store(sums[2], kWide, even_weight + i);
    hn::Store(sums[3], kWide, odd_weight + i);
  }
}

/// Column c of a row that is split in even and odd ones.
inline double& split_column(double* even, double* odd, int c) { return c & 1 ? odd[c >> 1] : even[c >> 1]; }

/// Puts the reflected columns -2, -1, width and width + 1 beside such a row.
inline void reflect_ends(double* even, double* odd, int width) {
  const int beyond[] = {-2, -1, width, width + 1};
  for (const int c : beyond) split_column(even, odd, c) = split_column(even, odd, reflect(c, width));
}

HWY_INLINE WideV filter_row(const double* even, const double* odd) {
  const WideV ends = hn::Add(hn::LoadU(kWide, even - 1), hn::LoadU(kWide, even + 1));
  const WideV sides = hn::Add(hn::LoadU(kWide, odd - 1), hn::LoadU(kWide, odd));
  return hn::Add(hn::MulAdd(hn::Set(kWide, 4.0), sides, ends),
                 hn::Mul(hn::Set(kWide, 6.0), hn::LoadU(kWide, even)));
}

/// Kernels::halve_rows
void halve_rows(const LevelPlanes& full, LevelPlanes& half, int begin, int end, RowScratch& scratch) {
  double* even_depth = scratch.halving[0].data();
  double* odd_depth = scratch.halving[1].data();
  double* even_weight = scratch.halving[2].data();
  double* odd_weight = scratch.halving[3].data();
  const WideV one = hn::Set(kWide, 1.0), zeros = hn::Zero(kWide);
  for (int r = begin; r < end; ++r) {
    BinomialRows window;
    for (int v = -2; v <= 2; ++v)
      window.rows[v + 2] = full.row(LevelPlanes::kDepth, reflect(2 * r + v, full.height()));
    filter_columns(window, full.width(), scratch);
    reflect_ends(even_depth, odd_depth, full.width());
    reflect_ends(even_weight, odd_weight, full.width());

    float* depth = half.row(LevelPlanes::kDepth, r);
    float* inverse = half.row(LevelPlanes::kInverse, r);
    for (int c = 0; c < half.width(); c += kWideLanes) {
      hn::Vec<HalfF> centre, unused;
      hn::LoadInterleaved2(kHalfF, window.rows[2] + 2 * c, centre, unused);
      const auto valid = hn::Gt(hn::PromoteTo(kWide, centre), zeros);
      const WideV sum = filter_row(even_depth + c, odd_depth + c);
      const WideV weight = hn::IfThenElse(valid, filter_row(even_weight + c, odd_weight + c), one);
      // Rounds halves up, as std::round does with positive numbers.
      const WideV eighths = hn::Div(hn::Mul(hn::Set(kWide, 8.0), sum), weight);
      const WideV below = hn::Floor(eighths);
      const auto up = hn::Ge(hn::Sub(eighths, below), hn::Set(kWide, 0.5));
      const WideV rounded = hn::Mul(hn::Add(below, hn::IfThenElseZero(up, one)), hn::Set(kWide, 0.125));
      hn::Store(hn::DemoteTo(kHalfF, hn::IfThenElseZero(valid, rounded)), kHalfF, depth + c);
    }
    for (int c = 0; c < half.width(); c += kLanes)
      store_depth(hn::Load(kF, depth + c), depth + c, inverse + c);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
