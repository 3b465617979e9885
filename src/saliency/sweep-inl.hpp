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

constexpr int kPlanes = 3;

/// Whether there are registers for the sums of all three planes at once. Where not, each column is swept
/// twice: for the positions, and with the selections of that sweep for the normals.
#if HWY_TARGET <= HWY_AVX3 || HWY_ARCH_ARM_A64
constexpr bool kSweepsOnce = true;
#else
constexpr bool kSweepsOnce = false;
#endif

/// Where the points of a level are, seen from a centre.
struct Points {
  const float *depth, *inverse, *packed, *normal_x, *normal_y, *normal_z;
  std::ptrdiff_t stride;

  Points(const LevelPlanes& level, std::ptrdiff_t at)
      : depth(level.plane(LevelPlanes::kDepth) + at),
        inverse(level.plane(LevelPlanes::kUsableInverse) + at),
        packed(level.plane(LevelPlanes::kPacked) + at),
        normal_x(level.plane(LevelPlanes::kNormalX) + at),
        normal_y(level.plane(LevelPlanes::kNormalY) + at),
        normal_z(level.plane(LevelPlanes::kNormalZ) + at),
        stride(level.stride()) {}
};

/// A part of one column of a window: `rows` pixels from `first_row` and `col`, relative to the centre.
struct ColumnPart {
  int first_row, rows, col;
};

/// The three planes through a centre as the sweep needs them.
struct SweepPlanes {
  V z0;                  ///< the centre's depth
  V along_ray[kPlanes];  ///< gamma.ray
  V per_col[kPlanes];    ///< -gamma.x/fx
  const float* terms;    ///< gamma.y/fy * dr: for each row of the window a vector for each plane

  SweepPlanes(const Vec3* gamma, const Centres& centres, const Window& window, V depth, float* memory)
      : z0(depth), terms(memory - window.first_row * kPlanes * kLanes) {
    for (int i = 0; i < kPlanes; ++i) {
      along_ray[i] = hn::MulAdd(gamma[i].x, centres.ray_x, hn::MulAdd(gamma[i].y, centres.ray_y, gamma[i].z));
      per_col[i] = hn::Mul(gamma[i].x, set(-centres.inverse_fx));
      const V per_row = hn::Mul(gamma[i].y, set(centres.inverse_fy));
      float* term = memory + i * kLanes;
      for (int dr = window.first_row; dr <= window.last_row; ++dr, term += kPlanes * kLanes)
        hn::Store(hn::Mul(per_row, set(kNumbers.value[dr + kNumbers.kLargest])), kF, term);
    }
  }
};

/// Adds to `counted` the packed count and depth, and to z_rows and, if kSweepsOnce, to the normals of `sums`
/// those points of a part of a column that lie in front of each plane; else their selections are stored.
HWY_INLINE void sweep_positions(const Points& points, const ColumnPart& part, const SweepPlanes& planes,
                                V (&counted)[kPlanes], HalfSums* sums, Selection* selections) {
  // Sums that change with every point are variables of their own, so that they stay in registers.
  V threshold[kPlanes], z_rows[kPlanes], sum_x[kPlanes], sum_y[kPlanes], sum_z[kPlanes];
  for (int i = 0; i < kPlanes; ++i) {
    threshold[i] = hn::Mul(planes.per_col[i], set(kNumbers.value[part.col + kNumbers.kLargest]));
    z_rows[i] = sums[i].z_rows;
    sum_x[i] = sums[i].normal.x, sum_y[i] = sums[i].normal.y, sum_z[i] = sums[i].normal.z;
  }
  std::ptrdiff_t j = part.first_row * points.stride + part.col;
  const float* term = planes.terms + part.first_row * kPlanes * kLanes;
  const float* row = kNumbers.value + kNumbers.kLargest + part.first_row;
  for (const float* const last = row + part.rows; row != last; ++row) {
    const V z = in_register(load(points.depth + j)), p = in_register(load(points.packed + j));
    const V q = hn::Mul(hn::Sub(z, planes.z0), load(points.inverse + j));
    V nx = zero(), ny = zero(), nz = zero();
    if constexpr (kSweepsOnce) {
      nx = in_register(load(points.normal_x + j));
      ny = in_register(load(points.normal_y + j));
      nz = in_register(load(points.normal_z + j));
    }
    const V dr = set(*row), z_times_row = hn::Mul(z, dr);
    for (int i = 0; i < kPlanes; ++i) {
      const V side = hn::MulAdd(planes.along_ray[i], q, hn::Load(kF, term + i * kLanes));
      const Selection front = select(hn::Gt(side, threshold[i]));  // Eq. (2)
      counted[i] = add_where(front, p, counted[i]);
      z_rows[i] = add_product_where(front, z, dr, z_times_row, z_rows[i]);
      if constexpr (kSweepsOnce) {
        sum_x[i] = add_where(front, nx, sum_x[i]);
        sum_y[i] = add_where(front, ny, sum_y[i]);
        sum_z[i] = add_where(front, nz, sum_z[i]);
      } else {
        *selections++ = front;
      }
    }
    j += points.stride;
    term += kPlanes * kLanes;
  }
  for (int i = 0; i < kPlanes; ++i) {
    sums[i].z_rows = z_rows[i];
    sums[i].normal = {sum_x[i], sum_y[i], sum_z[i]};
  }
}

/// Adds the normals of the selected points of a part of a column.
HWY_INLINE void sweep_normals(const Points& points, const ColumnPart& part, const Selection* selections,
                              HalfSums* sums) {
  V sum_x[kPlanes], sum_y[kPlanes], sum_z[kPlanes];
  for (int i = 0; i < kPlanes; ++i)
    sum_x[i] = sums[i].normal.x, sum_y[i] = sums[i].normal.y, sum_z[i] = sums[i].normal.z;
  std::ptrdiff_t j = part.first_row * points.stride + part.col;
  for (int v = 0; v < part.rows; ++v, j += points.stride, selections += kPlanes) {
    Selection front[kPlanes];
    for (int i = 0; i < kPlanes; ++i) front[i] = in_register(selections[i]);
    const V nx = in_register(load(points.normal_x + j));
    for (int i = 0; i < kPlanes; ++i) sum_x[i] = add_where(front[i], nx, sum_x[i]);
    const V ny = in_register(load(points.normal_y + j));
    for (int i = 0; i < kPlanes; ++i) sum_y[i] = add_where(front[i], ny, sum_y[i]);
    const V nz = in_register(load(points.normal_z + j));
    for (int i = 0; i < kPlanes; ++i) sum_z[i] = add_where(front[i], nz, sum_z[i]);
  }
  for (int i = 0; i < kPlanes; ++i) sums[i].normal = {sum_x[i], sum_y[i], sum_z[i]};
}

/// The sums over the points in front of the planes `gamma`, for the centres at `at` and following.
///
/// A point is in front if d = gamma.(p_j - p) > 0. With p = z*ray, and divided by z_j > 0, this is
///   gamma.ray * (z_j - z)/z_j + gamma.x/fx * dc + gamma.y/fy * dr > 0,
/// in which nothing cancels. 1/z_j is NaN where there is no point, so that the comparison fails.
///
/// Differs from Eq. (2): a point exactly on the plane, d = 0, comes to the half behind, which is what is left
/// of the window. With axes from measured normals that is chance; where it is not, on a frontal plane, all
/// scores are 0.
///
/// Columns are the outer loop: the sum of z of a column, times dc, gives the sum for x. Count and z share one
/// float, which is unpacked after every few rows.
HWY_INLINE void sum_in_front(const LevelPlanes& level, std::ptrdiff_t at, const Window& window,
                             const Centres& centres, const Vec3* gamma, float* terms, HalfSums* sums) {
  const Points points(level, at);
  const SweepPlanes planes(gamma, centres, window, load(points.depth), terms);
  const V count_unit = set(level.packing.count_unit), inverse_unit = set(1 / level.packing.count_unit);
  const V packed_z0 = hn::Sub(load(points.packed), count_unit);
  for (int i = 0; i < kPlanes; ++i) sums[i] = {zero(), zero(), zero(), zero(), {zero(), zero(), zero()}};

  Selection selections[kSweepsOnce ? 1 : kPlanes * DepthPacking::kMostRows];
  for (int dc = -window.reach; dc <= window.reach; ++dc) {
    const V col = set(kNumbers.value[dc + kNumbers.kLargest]);
    for (int begin = window.first_row; begin <= window.last_row; begin += level.packing.rows) {
      const ColumnPart part{begin, std::min(window.last_row + 1 - begin, level.packing.rows), dc};
      V counted[kPlanes] = {zero(), zero(), zero()};
      sweep_positions(points, part, planes, counted, sums, selections);
      for (int i = 0; i < kPlanes; ++i) {
        const V count = hn::Floor(hn::Mul(counted[i], inverse_unit));
        const V z = hn::NegMulAdd(count, count_unit, counted[i]);
        sums[i].count = hn::Add(sums[i].count, count);
        sums[i].z = hn::Add(sums[i].z, hn::NegMulAdd(count, packed_z0, z));
        sums[i].z_cols = hn::MulAdd(col, z, sums[i].z_cols);
      }
      if constexpr (!kSweepsOnce) sweep_normals(points, part, selections, sums);
    }
  }
  const V mm = set(1 / level.packing.units_per_mm);
  for (int i = 0; i < kPlanes; ++i) {
    sums[i].z = hn::Mul(sums[i].z, mm);
    sums[i].z_cols = hn::Mul(sums[i].z_cols, mm);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
