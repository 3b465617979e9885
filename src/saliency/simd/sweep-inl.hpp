// The inner loop: splits the points of a window by the candidate planes and sums the halves in front, Eq.
// (2). Compiled once for each instruction set.
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

/// The rows of a window, clipped at the border, and its reach in columns (which ends in the margins).
struct Window {
  int first_row, last_row;  ///< relative to the centre
  int reach;
};

/// DI numbers as floats, to be broadcast from memory: distances from the centre of a window.
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

/// Which pixels of a vector are points of the operator.
HWY_INLINE MF points_at(const LevelPlanes& level, int row, int col) {
  const auto packed = hn::BitCast(di, load(level.row(LevelPlanes::kPacked, row) + col));
  return hn::RebindMask(df, hn::Gt(packed, hn::Zero(di)));
}

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

/// A column of a window: its rows and where it is, relative to the centre.
struct Column {
  int first_row, last_row, col;
};

/// The three planes through a centre as the sweep needs them.
struct SweepPlanes {
  VF z0;                ///< the centre's depth
  VF per_col[kPlanes];  ///< -gamma.x/fx / gamma.ray: what a column adds to where the plane cuts the ray
  VF per_row[kPlanes];  ///< -gamma.y/fy / gamma.ray: what a row adds

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

/// Of each plane, the sums over the points in front that grow with every point. `counted` is packed, and is
/// unpacked before it overflows.
struct RunningSums {
  VI counted[kPlanes];
  VF z_rows[kPlanes], x[kPlanes], y[kPlanes], z[kPlanes];
};

/// Adds the points of a column that lie in front of each plane: their packed count and depth, z_rows and, if
/// kSweepsOnce, their normals; else their selections are stored.
HWY_INLINE void sweep_positions(const Points& points, const Column& column, const SweepPlanes& planes,
                                RunningSums& sums, Selection* selections) {
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
    VF nx = zero(), ny = zero(), nz = zero();
    if constexpr (kSweepsOnce) {
      nx = in_register(load(points.normal_x + j));
      ny = in_register(load(points.normal_y + j));
      nz = in_register(load(points.normal_z + j));
    }
    const VF dr = set(*row), z_times_row = hn::Mul(z, dr);
    for (int i = 0; i < kPlanes; ++i) {
      const MF m = hn::Gt(q, hn::MulAdd(per_row[i], dr, at_col[i]));  // Eq. (2)
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
                              RunningSums& sums) {
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

/// The sums over the points in front of the planes `gamma`, for the centres at `at` and following.
///
/// A point is in front if d = gamma.(p_j - p) > 0. With p = z*ray, and divided by z_j > 0, this is
///   gamma.ray * (z_j - z)/z_j + gamma.x/fx * dc + gamma.y/fy * dr > 0,
/// in which nothing cancels. It is divided by gamma.ray, so that one comparison with a linear function of row
/// and column decides; where gamma.ray < 0 that exchanges the halves, which is the same to the score. 1/z_j
/// is NaN where there is no point, so that the comparison fails.
///
/// Differs from Eq. (2): a point exactly on the plane, d = 0, comes to the half that is left of the window
/// once the one in front is taken away. With axes from measured normals that is chance; where it is not, on a
/// frontal plane, all scores are 0.
///
/// Columns are the outer loop: with Z_i the sum of z of a run of columns up to the i-th, of n,
/// sum(i * z) = n * Z_n - sum(Z_i), i = 1..n, so that z times the columns costs an addition a column.
HWY_INLINE void sum_in_front(const LevelPlanes& level, std::ptrdiff_t at, const Window& window,
                             const Centres& centres, const Vec3* gamma, HalfSums* sums) {
  const Points points(level, at);
  const SweepPlanes planes(gamma, centres, load(points.depth));
  const DepthPacking& packing = level.packing;
  const VI depth_mask = hn::Set(di, packing.depth_mask());
  const VI z0 = hn::And(hn::BitCast(di, load(points.packed)), depth_mask);
  RunningSums running;
  for (int i = 0; i < kPlanes; ++i) {
    sums[i].count = sums[i].z = sums[i].z_cols = zero();
    running.z_rows[i] = running.x[i] = running.y[i] = running.z[i] = zero();
  }
  Selection selections[kSweepsOnce ? 1 : kPlanes * (2 * kNumbers.kLargest - 1)];
  for (int begin = -window.reach; begin <= window.reach; begin += packing.columns) {
    const int end = std::min(begin + packing.columns, window.reach + 1);
    VI sum_of_sums[kPlanes];
    for (int i = 0; i < kPlanes; ++i) running.counted[i] = sum_of_sums[i] = hn::Zero(di);
    for (int dc = begin; dc < end; ++dc) {
      const Column column{window.first_row, window.last_row, dc};
      sweep_positions(points, column, planes, running, selections);
      if constexpr (!kSweepsOnce) sweep_normals(points, column, selections, running);
      for (int i = 0; i < kPlanes; ++i)
        sum_of_sums[i] = hn::Add(sum_of_sums[i], hn::And(running.counted[i], depth_mask));
    }
    for (int i = 0; i < kPlanes; ++i) {
      const VI z = hn::And(running.counted[i], depth_mask);
      const VI count = shift_right(running.counted[i], packing.depth_bits);
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
    sums[i].z_rows = running.z_rows[i];
    sums[i].normal = {running.x[i], running.y[i], running.z[i]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
