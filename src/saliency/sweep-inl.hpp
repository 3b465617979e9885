// The inner loop: splits the points of a window by the candidate planes and sums the halves in front, Eq.
// (2). Compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_SWEEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_SWEEP_INL
#undef SACCADE_SALIENCY_SWEEP_INL
#else
#define SACCADE_SALIENCY_SWEEP_INL
#endif

#include <algorithm>

#include "saliency/level_planes.hpp"
#include "saliency/plane_score-inl.hpp"
#include "saliency/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// The rows of a window, clipped at the border, and its reach in columns (which ends in the margins).
struct Window {
  int first_row, last_row;  ///< relative to the centre
  int reach;
};

/// Whole numbers as floats, to be broadcast from memory: distances from the centre of a window.
struct Numbers {
  static constexpr int kLargest = 64;
  float value[2 * kLargest + 1];
  constexpr Numbers() : value() {
    for (int i = 0; i <= 2 * kLargest; ++i) value[i] = static_cast<float>(i - kLargest);
  }
};
constexpr Numbers kNumbers;

/// Planes that are handled in one pass: all three where there are registers for their sums.
#if HWY_TARGET <= HWY_AVX3 || HWY_ARCH_ARM_A64
constexpr int kPlanesPerPass = 3;
#else
constexpr int kPlanesPerPass = 1;
#endif

/// The sums over the points in front of the planes `gamma`, for the centres at `at` and following.
///
/// A point is in front if d = gamma.(p_j - p) > 0. With p = z*ray, and divided by z_j > 0, this is
///   gamma.ray * (z_j - z)/z_j + gamma.x/fx * dc + gamma.y/fy * dr > 0,
/// in which nothing cancels. 1/z_j is NaN where there is no point, so that the comparison fails.
///
/// Columns are the outer loop: the sum of z of a column, times dc, gives the sum for x. Count and z share one
/// float, which is unpacked after every few rows.
template <int kCount>
HWY_INLINE void sum_in_front(const LevelPlanes& level, std::ptrdiff_t at, const Window& window,
                             const Centres& centres, const Vec3* gamma, float* terms, HalfSums* sums) {
  const float* depth = level.plane(LevelPlanes::kDepth) + at;
  const float* inverse = level.plane(LevelPlanes::kUsableInverse) + at;
  const float* packed = level.plane(LevelPlanes::kPacked) + at;
  const float* normal_x = level.plane(LevelPlanes::kNormalX) + at;
  const float* normal_y = level.plane(LevelPlanes::kNormalY) + at;
  const float* normal_z = level.plane(LevelPlanes::kNormalZ) + at;
  const std::ptrdiff_t stride = level.stride();
  const V z0 = load(depth);
  const V count_unit = set(level.packing.count_unit), inverse_unit = set(1 / level.packing.count_unit);
  const V packed_z0 = hn::Sub(load(packed), count_unit);

  const int rows = window.last_row - window.first_row + 1;
  V along_ray[kCount], per_col[kCount];
  for (int i = 0; i < kCount; ++i) {
    along_ray[i] = hn::MulAdd(gamma[i].x, centres.ray_x, hn::MulAdd(gamma[i].y, centres.ray_y, gamma[i].z));
    per_col[i] = hn::Mul(gamma[i].x, set(-centres.inverse_fx));
    const V per_row = hn::Mul(gamma[i].y, set(centres.inverse_fy));
    for (int v = 0; v < rows; ++v)
      hn::Store(hn::Mul(per_row, set(kNumbers.value[window.first_row + v + kNumbers.kLargest])), kF,
                terms + (v * kCount + i) * kLanes);
    sums[i].count = sums[i].z = sums[i].z_cols = zero();
  }

  // Sums that change with every point are variables of their own, so that they stay in registers.
  V z_rows[kCount], sum_x[kCount], sum_y[kCount], sum_z[kCount];
  for (int i = 0; i < kCount; ++i) z_rows[i] = sum_x[i] = sum_y[i] = sum_z[i] = zero();
  for (int dc = -window.reach; dc <= window.reach; ++dc) {
    const V col = set(static_cast<float>(dc));
    V threshold[kCount];
    for (int i = 0; i < kCount; ++i) threshold[i] = hn::Mul(per_col[i], col);
    for (int begin = 0; begin < rows; begin += level.packing.rows) {
      const int end = std::min(rows, begin + level.packing.rows);
      V counted[kCount];
      for (int i = 0; i < kCount; ++i) counted[i] = zero();
      std::ptrdiff_t j = (window.first_row + begin) * stride + dc;
      const float* term = terms + begin * kCount * kLanes;
      const float* row = kNumbers.value + kNumbers.kLargest + window.first_row + begin;
      const float* const last = kNumbers.value + kNumbers.kLargest + window.first_row + end;
      for (; row != last; ++row, j += stride, term += kCount * kLanes) {
        const V z = in_register(load(depth + j)), p = in_register(load(packed + j));
        const V q = hn::Mul(hn::Sub(z, z0), load(inverse + j));
        const V nx = in_register(load(normal_x + j)), ny = in_register(load(normal_y + j)),
                nz = in_register(load(normal_z + j));
        const V dr = set(*row);
        for (int i = 0; i < kCount; ++i) {
          const V side = hn::MulAdd(along_ray[i], q, hn::Load(kF, term + i * kLanes));
          const M front = hn::Gt(side, threshold[i]);  // Eq. (2)
          counted[i] = add_where(front, p, counted[i]);
          z_rows[i] = mul_add_where(front, z, dr, z_rows[i]);
          sum_x[i] = add_where(front, nx, sum_x[i]);
          sum_y[i] = add_where(front, ny, sum_y[i]);
          sum_z[i] = add_where(front, nz, sum_z[i]);
        }
      }
      for (int i = 0; i < kCount; ++i) {
        const V count = hn::Floor(hn::Mul(counted[i], inverse_unit));
        const V z = hn::NegMulAdd(count, count_unit, counted[i]);
        sums[i].count = hn::Add(sums[i].count, count);
        sums[i].z = hn::Add(sums[i].z, hn::NegMulAdd(count, packed_z0, z));
        sums[i].z_cols = hn::MulAdd(col, z, sums[i].z_cols);
      }
    }
  }
  const V mm = set(1 / level.packing.units_per_mm);
  for (int i = 0; i < kCount; ++i) {
    sums[i].z = hn::Mul(sums[i].z, mm);
    sums[i].z_cols = hn::Mul(sums[i].z_cols, mm);
    sums[i].z_rows = z_rows[i];
    sums[i].normal = {sum_x[i], sum_y[i], sum_z[i]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
