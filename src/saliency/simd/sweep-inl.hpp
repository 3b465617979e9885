// The inner loop for small windows: splits the points of a window by the candidate planes and sums the halves
// in front, section 2.2. Compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_SWEEP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_SWEEP_INL
#undef SACCADE_SALIENCY_SWEEP_INL
#else
#define SACCADE_SALIENCY_SWEEP_INL
#endif

#include <algorithm>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/plane_score-inl.hpp"
#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// The rows of a window, clipped at the border, and its reach in columns, where the margins replace clipping.
struct Window {
  int first_row, last_row;  ///< relative to the centre
  int reach;
};

/// Integers as floats, to be broadcast from memory: distances from the centre of a window.
struct Numbers {
  static constexpr int kLargest = 64;
  float value[2 * kLargest + 1];
  constexpr Numbers() : value() {
    for (int i = 0; i <= 2 * kLargest; ++i) value[i] = static_cast<float>(i - kLargest);
  }
};
constexpr Numbers kNumbers;

constexpr int kPlanes = 3;

/// Whether there are enough registers for the sums of all three planes at once. If not, each column is swept
/// twice: first for the positions, then for the normals with the selections of the first sweep.
#if HWY_TARGET <= HWY_AVX3 || HWY_ARCH_ARM_A64
constexpr bool kSweepsOnce = true;
#else
constexpr bool kSweepsOnce = false;
#endif

/// Which pixels of a vector are points of the operator.
HWY_INLINE MF points_at(const LevelPlanes& level, int row, int col) {
  const auto packed = hn::BitCast(di, load(level.row(LevelPlanes::kPacked, row) + col));
  return hn::RebindMask(df, hn::Gt(packed, hn::Zero(di)));
}

/// The planes of a level at the centres of a vector.
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

/// A column of a window, relative to the centre.
struct Column {
  int first_row, last_row, col;
};

/// The three planes through a centre as the sweep needs them.
struct SweepPlanes {
  VF z0;                ///< the centre's depth
  VF per_col[kPlanes];  ///< -gamma.x/fx / gamma.ray: the plane along columns, see sum_in_front()
  VF per_row[kPlanes];  ///< -gamma.y/fy / gamma.ray: along rows

  SweepPlanes(const Vec3* gamma, const Centres& centres, VF depth) : z0(depth) {
    for (int i = 0; i < kPlanes; ++i) {
      const VF along_ray =
          hn::MulAdd(gamma[i].x, centres.ray_x, hn::MulAdd(gamma[i].y, centres.ray_y, gamma[i].z));
      const VF tiny = set(1e-12f);
      const VF factor =
          hn::Div(set(-1.0f), hn::IfThenElse(hn::Gt(hn::Abs(along_ray), tiny), along_ray, tiny));
      per_col[i] = hn::Mul(hn::Mul(gamma[i].x, set(centres.inverse_fx)), factor);
      per_row[i] = hn::Mul(hn::Mul(gamma[i].y, set(centres.inverse_fy)), factor);
    }
  }
};

/// For each plane, the sums over the points in front that every point adds to. `counted` is packed, and is
/// unpacked before it overflows.
struct FrontSums {
  VI counted[kPlanes];
  VF z_rows[kPlanes], x[kPlanes], y[kPlanes], z[kPlanes];
};

/// Adds the points of a column that lie in front of each plane: packed count and depth, z_rows and, if
/// kSweepsOnce, normals; otherwise stores their selections.
HWY_INLINE void sweep_positions(const Points& points, const Column& column, const SweepPlanes& planes,
                                FrontSums& sums, Selection* selections) {
  VF per_row[kPlanes], at_col[kPlanes];
  for (int i = 0; i < kPlanes; ++i) {
    at_col[i] = hn::Mul(planes.per_col[i], set(kNumbers.value[column.col + kNumbers.kLargest]));
    per_row[i] = planes.per_row[i];
  }
  std::ptrdiff_t j = column.first_row * points.stride + column.col;
  const float* row = kNumbers.value + kNumbers.kLargest + column.first_row;
  for (const float* const end = kNumbers.value + kNumbers.kLargest + column.last_row + 1; row != end; ++row) {
    const VF z = in_register(load(points.depth + j));
    const VI p = in_register(hn::BitCast(di, load(points.packed + j)));
    const VF q = hn::Mul(hn::Sub(z, planes.z0), load(points.inverse + j));
    // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): read only where there is one sweep.
    VF nx = zero(), ny = zero(), nz = zero();
    if constexpr (kSweepsOnce) {
      nx = in_register(load(points.normal_x + j));
      ny = in_register(load(points.normal_y + j));
      nz = in_register(load(points.normal_z + j));
    }
    const VF dr = set(*row), z_times_row = hn::Mul(z, dr);
    for (int i = 0; i < kPlanes; ++i) {
      // Eq. (2)
      const MF m = hn::Gt(q, hn::MulAdd(per_row[i], dr, at_col[i]));
      const Selection front = select(m);
      sums.counted[i] = add_where(m, p, sums.counted[i]);
      sums.z_rows[i] = add_product_where(front, z, dr, z_times_row, sums.z_rows[i]);
      if constexpr (kSweepsOnce) {
        sums.x[i] = add_where(front, nx, sums.x[i]);
        sums.y[i] = add_where(front, ny, sums.y[i]);
        sums.z[i] = add_where(front, nz, sums.z[i]);
      } else {
        *selections++ = front;
      }
    }
    j += points.stride;
  }
}

/// Adds the normals of the selected points of a column.
HWY_INLINE void sweep_normals(const Points& points, const Column& column, const Selection* selections,
                              FrontSums& sums) {
  std::ptrdiff_t j = column.first_row * points.stride + column.col;
  for (int v = column.first_row; v <= column.last_row; ++v, j += points.stride, selections += kPlanes) {
    Selection front[kPlanes];
    for (int i = 0; i < kPlanes; ++i) front[i] = in_register(selections[i]);
    const VF nx = in_register(load(points.normal_x + j));
    for (int i = 0; i < kPlanes; ++i) sums.x[i] = add_where(front[i], nx, sums.x[i]);
    const VF ny = in_register(load(points.normal_y + j));
    for (int i = 0; i < kPlanes; ++i) sums.y[i] = add_where(front[i], ny, sums.y[i]);
    const VF nz = in_register(load(points.normal_z + j));
    for (int i = 0; i < kPlanes; ++i) sums.z[i] = add_where(front[i], nz, sums.z[i]);
  }
}

/// The sums over the points in front of the planes `gamma`, for the centres at `at` and the following pixels.
///
/// A point is in front if d = gamma.(p_j - p) > 0. With p = z*ray, and divided by z_j > 0, this is
///   gamma.ray * (z_j - z)/z_j + gamma.x/fx * dc + gamma.y/fy * dr > 0,
/// in which nothing cancels. Division by gamma.ray leaves one comparison with a linear function of row and
/// column; if gamma.ray < 0 it exchanges the halves, which does not change the score. 1/z_j is NaN where
/// there is no point, so that the comparison fails.
///
/// Differs from Eq. (2): a point exactly on the plane, d = 0, falls into the half behind, which is the window
/// minus the half in front. With axes from measured normals such points are chance; on a frontal plane, where
/// they are not, all scores are 0.
///
/// Columns are the outer loop. With Z_i the sum of z over columns 0..i of n, the sum of i * z is n * Z_(n-1)
/// minus the sum of all Z_i, so that z times the columns costs one addition a column.
HWY_INLINE void sum_in_front(const LevelPlanes& level, std::ptrdiff_t at, const Window& window,
                             const Centres& centres, const Vec3* gamma, HalfSums* sums) {
  const Points points(level, at);
  const SweepPlanes planes(gamma, centres, load(points.depth));
  const DepthPacking& packing = level.packing;
  const VI depth_mask = hn::Set(di, packing.depth_mask());
  const VI z0 = hn::And(hn::BitCast(di, load(points.packed)), depth_mask);
  FrontSums front_sums;
  for (int i = 0; i < kPlanes; ++i) {
    sums[i].count = sums[i].z = sums[i].z_cols = zero();
    front_sums.z_rows[i] = front_sums.x[i] = front_sums.y[i] = front_sums.z[i] = zero();
  }
  Selection selections[kSweepsOnce ? 1 : kPlanes * (2 * kNumbers.kLargest - 1)];
  for (int begin = -window.reach; begin <= window.reach; begin += packing.columns) {
    const int end = std::min(begin + packing.columns, window.reach + 1);
    VI sum_of_sums[kPlanes];
    for (int i = 0; i < kPlanes; ++i) front_sums.counted[i] = sum_of_sums[i] = hn::Zero(di);
    for (int dc = begin; dc < end; ++dc) {
      const Column column{window.first_row, window.last_row, dc};
      sweep_positions(points, column, planes, front_sums, selections);
      if constexpr (!kSweepsOnce) sweep_normals(points, column, selections, front_sums);
      for (int i = 0; i < kPlanes; ++i)
        sum_of_sums[i] = hn::Add(sum_of_sums[i], hn::And(front_sums.counted[i], depth_mask));
    }
    for (int i = 0; i < kPlanes; ++i) {
      const VI z = hn::And(front_sums.counted[i], depth_mask);
      const VI count = shift_right(front_sums.counted[i], packing.depth_bits);
      const VI from_begin = hn::Sub(hn::Mul(z, hn::Set(di, end - begin)), sum_of_sums[i]);
      sums[i].count = hn::Add(sums[i].count, hn::ConvertTo(df, count));
      sums[i].z = hn::Add(sums[i].z, hn::ConvertTo(df, hn::Sub(z, hn::Mul(count, z0))));
      sums[i].z_cols = hn::Add(
          sums[i].z_cols,
          hn::MulAdd(hn::ConvertTo(df, z), set(static_cast<float>(begin)), hn::ConvertTo(df, from_begin)));
    }
  }
  const VF mm = set(1 / packing.units_per_mm);
  for (int i = 0; i < kPlanes; ++i) {
    sums[i].z = hn::Mul(sums[i].z, mm);
    sums[i].z_cols = hn::Mul(sums[i].z_cols, mm);
    sums[i].z_rows = front_sums.z_rows[i];
    sums[i].normal = {front_sums.x[i], front_sums.y[i], front_sums.z[i]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
