// The axes of the Extended Gaussian Image, section 2.1; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_AXES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_AXES_INL
#undef SACCADE_SALIENCY_AXES_INL
#else
#define SACCADE_SALIENCY_AXES_INL
#endif

#include <algorithm>
#include <limits>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"
#include "saliency/simd/vectors-inl.hpp"
#include "saliency/simd/window_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// For each pixel of row r: the covariance of the normals and the sums over the whole window. The covariance
/// is a difference of nearly equal numbers where surfaces are flat, so it is computed in double.
HWY_INLINE void window_statistics(const LevelPlanes& level, int r, int reach, WindowPrefixSums& sums,
                                  RowStatistics& statistics) {
  using S = RowStatistics;
  using C = VerticalSums;
  const VD normal_unit = hn::Set(dd, 1.0 / normal_units(reach));
  const VD inverse_units = hn::Set(dd, 1.0 / static_cast<double>(level.packing.units_per_mm));
  const auto depth_mask = hn::Set(dhi, level.packing.depth_mask());
  const float* packed = level.row(LevelPlanes::kPacked, r);
  for (int c = 0; c < level.width(); c += kDoubleLanes) {
    const auto window = [&](auto tag, auto* row) HWY_ATTR {
      return hn::Sub(hn::LoadU(tag, row + c + reach), hn::LoadU(tag, row + c - reach - 1));
    };
    const auto integer = [&](int i) HWY_ATTR {
      return window(dhi, sums.integers[static_cast<std::size_t>(i)].data());
    };
    const auto depth = [&](int i) HWY_ATTR {
      return hn::Mul(window(dd, sums.doubles[static_cast<std::size_t>(i)].data()), inverse_units);
    };
    const auto normal = [&](C::Sum i)
                            HWY_ATTR { return hn::Mul(hn::PromoteTo(dd, integer(i)), normal_unit); };
    const auto put = [&](S::Value value, VD v)
                         HWY_ATTR { hn::Store(hn::DemoteTo(dhf, v), dhf, statistics.row(value) + c); };
    const VD x = normal(C::kX), y = normal(C::kY), z = normal(C::kZ);
    const VD xx = normal(C::kXX), yy = normal(C::kYY), zz = normal(C::kZZ);
    const VD n = hn::Round(hn::Add(xx, hn::Add(yy, zz)));  // normals have length 1
    // n^2 times the covariance; the axes do not depend on its scale.
    put(S::kCovXX, hn::NegMulAdd(x, x, hn::Mul(n, xx)));
    put(S::kCovYY, hn::NegMulAdd(y, y, hn::Mul(n, yy)));
    put(S::kCovZZ, hn::NegMulAdd(z, z, hn::Mul(n, zz)));
    put(S::kCovXY, hn::NegMulAdd(x, y, hn::Mul(n, normal(C::kXY))));
    put(S::kCovXZ, hn::NegMulAdd(x, z, hn::Mul(n, normal(C::kXZ))));
    put(S::kCovYZ, hn::NegMulAdd(y, z, hn::Mul(n, normal(C::kYZ))));

    const auto centre = [&](LevelPlanes::Plane plane)
                            HWY_ATTR { return hn::PromoteTo(dd, hn::Load(dhf, level.row(plane, r) + c)); };
    // The sum of depths uses all 32 bits and is unsigned.
    const auto top = hn::Set(dhi, std::numeric_limits<std::int32_t>::min());
    const VD z_units =
        hn::Sub(hn::PromoteTo(dd, hn::Xor(integer(WindowPrefixSums::kDepth), top)), hn::PromoteTo(dd, top));
    const VD z0 = hn::PromoteTo(dd, hn::And(hn::BitCast(dhi, hn::Load(dhf, packed + c)), depth_mask));
    put(S::kCount, hn::Sub(n, hn::Set(dd, 1.0)));
    put(S::kZ, hn::Mul(hn::NegMulAdd(n, z0, z_units), inverse_units));
    put(S::kZRows, depth(WindowPrefixSums::kDepthRows));
    put(S::kZCols, hn::NegMulAdd(hn::Mul(z_units, inverse_units), hn::Iota(dd, static_cast<double>(c)),
                                 depth(WindowPrefixSums::kDepthCols)));
    put(S::kNormalX, hn::Sub(x, centre(LevelPlanes::kNormalX)));
    put(S::kNormalY, hn::Sub(y, centre(LevelPlanes::kNormalY)));
    put(S::kNormalZ, hn::Sub(z, centre(LevelPlanes::kNormalZ)));
  }
}

/// A symmetric matrix that rotations bring to diagonal form, and the product of the rotations so far.
struct Diagonalisation {
  VF xx, yy, zz, xy, xz, yz;
  VF axes[3][2];  ///< [axis][x, y]; z follows from these
};

/// One Jacobi rotation, which makes apq 0. arp and arq are the elements of p and q with the third index.
HWY_INLINE void rotate(VF& app, VF& aqq, VF& apq, VF& arp, VF& arq, VF (&axis_p)[2], VF (&axis_q)[2]) {
  // cos(2a) = |d|/h and sin(2a) = 2apq/h with h^2 = d^2 + (2apq)^2 for the smaller of the two angles.
  const VF difference = hn::Sub(aqq, app), twice = hn::Add(apq, apq);
  const VF magnitude = hn::Max(hn::Abs(difference), set(1e-15f));  // no rotation of a zero matrix
  const VF inverse = reciprocal_sqrt(hn::MulAdd(magnitude, magnitude, hn::Mul(twice, twice)));
  const VF square_of_c = hn::MulAdd(hn::Mul(magnitude, inverse), set(0.5f), set(0.5f));
  const VF inverse_of_c = reciprocal_sqrt(square_of_c);
  const VF half_sine = hn::Mul(hn::Xor(apq, hn::And(difference, hn::SignBit(df))), inverse);
  const VF c = hn::Mul(square_of_c, inverse_of_c), s = hn::Mul(half_sine, inverse_of_c);
  const VF t = hn::Mul(s, inverse_of_c);
  app = hn::NegMulAdd(t, apq, app);
  aqq = hn::MulAdd(t, apq, aqq);
  apq = zero();
  const VF rp = arp;
  arp = hn::NegMulAdd(s, arq, hn::Mul(c, rp));
  arq = hn::MulAdd(s, rp, hn::Mul(c, arq));
  for (int i = 0; i < 2; ++i) {
    const VF p = axis_p[i];
    axis_p[i] = hn::NegMulAdd(s, axis_q[i], hn::Mul(c, p));
    axis_q[i] = hn::MulAdd(s, p, hn::Mul(c, axis_q[i]));
  }
}

/// Permutes the axes cyclically (which leaves them right-handed) so that the one of the smallest eigenvalue,
/// whose plane lies along the surface, comes last: the lanes of a vector then agree on which plane is which.
HWY_INLINE void last_is_smallest(Diagonalisation& a) {
  const MF first = hn::And(hn::Lt(a.xx, a.yy), hn::Lt(a.xx, a.zz)), second = hn::Lt(a.yy, a.zz);
  for (int j = 0; j < 2; ++j) {
    const VF x = a.axes[0][j], y = a.axes[1][j], z = a.axes[2][j];
    a.axes[0][j] = hn::IfThenElse(first, y, hn::IfThenElse(second, z, x));
    a.axes[1][j] = hn::IfThenElse(first, z, hn::IfThenElse(second, x, y));
    a.axes[2][j] = hn::IfThenElse(first, x, hn::IfThenElse(second, y, z));
  }
}

/// Eigenvectors of the covariance in the groups of a row, by cyclic Jacobi rotations. Each rotation depends
/// on the one before, so kTogether groups are processed together; the last group is repeated to fill up.
HWY_INLINE void gaussian_image_axes(RowStatistics& statistics) {
  using S = RowStatistics;
  constexpr std::size_t kTogether = 4;
  constexpr int kSweeps = 3;
  const std::size_t count = statistics.groups.size();
  for (std::size_t begin = 0; begin < count; begin += kTogether) {
    const auto row = [&](int value, std::size_t g) {
      return statistics.row(value) + statistics.groups[std::min(begin + g, count - 1)];
    };
    Diagonalisation m[kTogether];
    for (std::size_t g = 0; g < kTogether; ++g) {
      const auto get = [&](S::Value value) HWY_ATTR { return load(row(value, g)); };
      const VF n = hn::Add(get(S::kCount), set(1.0f));
      const VF scale = reciprocal(hn::Max(hn::Mul(n, n), set(1.0f)));
      m[g].xx = hn::Mul(get(S::kCovXX), scale);
      m[g].yy = hn::Mul(get(S::kCovYY), scale);
      m[g].zz = hn::Mul(get(S::kCovZZ), scale);
      m[g].xy = hn::Mul(get(S::kCovXY), scale);
      m[g].xz = hn::Mul(get(S::kCovXZ), scale);
      m[g].yz = hn::Mul(get(S::kCovYZ), scale);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 2; ++j) m[g].axes[i][j] = set(i == j ? 1.0f : 0.0f);
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (auto& a : m) rotate(a.xx, a.yy, a.xy, a.xz, a.yz, a.axes[0], a.axes[1]);
      for (auto& a : m) rotate(a.xx, a.zz, a.xz, a.xy, a.yz, a.axes[0], a.axes[2]);
      for (auto& a : m) rotate(a.yy, a.zz, a.yz, a.xy, a.xz, a.axes[1], a.axes[2]);
    }
    for (auto& a : m) last_is_smallest(a);
    for (std::size_t g = 0; g < kTogether; ++g)
      for (int i = 0; i < 3; ++i) {
        const auto put = [&](int component, VF v)
                             HWY_ATTR { hn::StoreU(v, df, row(S::kAxis0 + 3 * i + component, g)); };
        const VF(&next)[2] = m[g].axes[(i + 1) % 3], (&last)[2] = m[g].axes[(i + 2) % 3];
        put(0, m[g].axes[i][0]);
        put(1, m[g].axes[i][1]);
        put(2, hn::NegMulAdd(next[1], last[0], hn::Mul(next[0], last[1])));  // z of next x last
      }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
