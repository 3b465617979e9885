// Normals and the operator's points, section 1.3; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_NORMALS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_NORMALS_INL
#undef SACCADE_SALIENCY_NORMALS_INL
#else
#define SACCADE_SALIENCY_NORMALS_INL
#endif

#include <limits>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

constexpr int kNormalReach = 2;  // 5 x 5

/// Sums of the least-squares fit of q = a*u + b*v + c over the pixels (u, v) of a window that continue the
/// centre's surface. q = z0/z - 1 is the inverse depth relative to the centre's; computed as (z0 - z)/z it
/// does not cancel, since differences of depths are exact.
struct PlaneFitSums {
  VF n, u, v, uu, vv, uv, q, uq, vq;
};

HWY_INLINE PlaneFitSums sum_plane_fit(const LevelPlanes& level, std::ptrdiff_t at) {
  const VF z0 = load(level.plane(LevelPlanes::kDepth) + at);
  const VF same_surface = hn::Div(z0, set(50.0f));  // 2 %
  PlaneFitSums s{zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero(), zero()};
  for (int v = -kNormalReach; v <= kNormalReach; ++v) {
    VF row_n = zero(), row_u = zero(), row_uu = zero(), row_q = zero(), row_uq = zero();
    const std::ptrdiff_t row = at + v * level.stride();
    for (int u = -kNormalReach; u <= kNormalReach; ++u) {
      const VF dz = hn::Sub(z0, load(level.plane(LevelPlanes::kDepth) + row + u));
      const MF m = hn::Le(hn::Abs(dz), same_surface);
      const VF q = hn::IfThenElseZero(m, hn::Mul(dz, load(level.plane(LevelPlanes::kInverse) + row + u)));
      const VF fu = set(static_cast<float>(u)), fuu = set(static_cast<float>(u * u));
      row_n = add_where(select(m), set(1.0f), row_n);
      row_u = add_where(select(m), fu, row_u);
      row_uu = add_where(select(m), fuu, row_uu);
      row_q = hn::Add(row_q, q);
      row_uq = hn::MulAdd(q, fu, row_uq);
    }
    const VF fv = set(static_cast<float>(v));
    s.n = hn::Add(s.n, row_n);
    s.u = hn::Add(s.u, row_u);
    s.uu = hn::Add(s.uu, row_uu);
    s.v = hn::MulAdd(row_n, fv, s.v);
    s.vv = hn::MulAdd(row_n, hn::Mul(fv, fv), s.vv);
    s.uv = hn::MulAdd(row_u, fv, s.uv);
    s.q = hn::Add(s.q, row_q);
    s.uq = hn::Add(s.uq, row_uq);
    s.vq = hn::MulAdd(row_q, fv, s.vq);
  }
  return s;
}

/// The normals of the fitted planes at pixels (row, col..); `found` marks the lanes that have one.
HWY_INLINE Vec3 normal_of_fit(const PlaneFitSums& s, const Intrinsics& camera, int row, int col, MF& found) {
  // n times the central moments. Those of u and v are integers, so the test for "all on one line" is exact.
  const VF uu = hn::NegMulAdd(s.u, s.u, hn::Mul(s.n, s.uu)), vv = hn::NegMulAdd(s.v, s.v, hn::Mul(s.n, s.vv)),
           uv = hn::NegMulAdd(s.u, s.v, hn::Mul(s.n, s.uv)), uq = hn::NegMulAdd(s.u, s.q, hn::Mul(s.n, s.uq)),
           vq = hn::NegMulAdd(s.v, s.q, hn::Mul(s.n, s.vq));
  const VF determinant = hn::NegMulAdd(uv, uv, hn::Mul(uu, vv));
  found = hn::And(hn::Ge(s.n, set(3.0f)), hn::Ne(determinant, zero()));
  const VF inverse = hn::Div(set(1.0f), hn::IfThenElse(found, determinant, set(1.0f)));
  const VF a = hn::Mul(hn::NegMulAdd(vq, uv, hn::Mul(uq, vv)), inverse),
           b = hn::Mul(hn::NegMulAdd(uq, uv, hn::Mul(vq, uu)), inverse);
  const VF c =
      hn::Mul(hn::NegMulAdd(a, s.u, hn::NegMulAdd(b, s.v, s.q)), reciprocal(hn::Max(s.n, set(1.0f))));
  // 1/z = a'x + b'y + c' over the rays x, y. `plane` is (a', b', c') times the centre's depth.
  const VF cols = hn::Add(hn::Iota(df, 0.0f), set(col - camera.cx)), rows = set(row - camera.cy);
  const Vec3 plane{hn::Mul(a, set(camera.fx)), hn::Mul(b, set(camera.fy)),
                   hn::NegMulAdd(a, cols, hn::NegMulAdd(b, rows, hn::Add(set(1.0f), c)))};
  return plane * hn::Neg(reciprocal_sqrt(hn::IfThenElse(found, dot(plane, plane), set(1.0f))));
}

/// SimdStages::normal_rows
void normal_rows(LevelPlanes& level, int begin, int end) {
  const VF nan = set(std::numeric_limits<float>::quiet_NaN());
  const auto one = hn::Set(di, level.packing.one());
  const VF per_mm = set(level.packing.units_per_mm);
  for (int r = begin; r < end; ++r)
    for (int c = 0; c < level.width(); c += kLanes) {
      const std::ptrdiff_t at = level.at(r, c);
      const VF z = hn::Load(df, level.plane(LevelPlanes::kDepth) + at);
      const MF has_depth = hn::Gt(z, zero());
      Vec3 normal{zero(), zero(), zero()};
      MF usable = has_depth;
      if (!hn::AllFalse(df, has_depth)) {
        MF found;
        normal = normal_of_fit(sum_plane_fit(level, at), level.camera, r, c, found);
        usable = hn::And(has_depth, found);
      }
      const auto put = [&](LevelPlanes::Plane plane, VF v)
                           HWY_ATTR { hn::Store(v, df, level.plane(plane) + at); };
      put(LevelPlanes::kNormalX, hn::IfThenElseZero(usable, normal.x));
      put(LevelPlanes::kNormalY, hn::IfThenElseZero(usable, normal.y));
      put(LevelPlanes::kNormalZ, hn::IfThenElseZero(usable, normal.z));
      put(LevelPlanes::kUsableInverse,
          hn::IfThenElse(usable, hn::Load(df, level.plane(LevelPlanes::kInverse) + at), nan));
      const VF packed = hn::BitCast(df, hn::Add(one, nearest(hn::Mul(z, per_mm))));
      put(LevelPlanes::kPacked, hn::IfThenElseZero(usable, packed));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
