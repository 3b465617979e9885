// The score of one candidate plane from the sums of its halves, sections 2.3 to 2.8, Eqs. (3) to (14);
// compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_PLANE_SCORE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_PLANE_SCORE_INL
#undef SACCADE_SALIENCY_PLANE_SCORE_INL
#else
#define SACCADE_SALIENCY_PLANE_SCORE_INL
#endif

#include <hwy/contrib/math/math-inl.h>

#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Sums over points of a window with centre p: their number, z - p.z in mm, z times their row and column
/// relative to the centre, and normals.
struct HalfSums {
  VF count, z, z_rows, z_cols;
  Vec3 normal;
};

/// The pixels of one vector as centres of windows.
struct Centres {
  VF ray_x, ray_y;          ///< p = z * (ray_x, ray_y, 1)
  VF minus_inverse_lambda;  ///< -1/lambda, 1/mm
  float inverse_fx, inverse_fy;
};

/// Sums over a half: number of points, points relative to p (mm), normals.
struct Half {
  VF count;
  Vec3 point, normal;
};

/// x_j - p.x = ray_x*(z_j - p.z) + z_j*dc/fx, and likewise for y.
HWY_INLINE Half half_of(const HalfSums& sums, const Centres& centres) {
  const VF x = hn::MulAdd(centres.ray_x, sums.z, hn::Mul(sums.z_cols, set(centres.inverse_fx)));
  const VF y = hn::MulAdd(centres.ray_y, sums.z, hn::Mul(sums.z_rows, set(centres.inverse_fy)));
  return {sums.count, {x, y, sums.z}, sums.normal};
}

HWY_INLINE Half operator-(const Half& a, const Half& b) {
  return {hn::Sub(a.count, b.count), a.point - b.point, a.normal - b.normal};
}

/// v/|v|; shorter than 1 where v is nearly 0.
HWY_INLINE Vec3 normalised(const Vec3& v) { return v * reciprocal_sqrt(hn::Max(dot(v, v), set(1e-30f))); }

/// Eq. (8): omega_1 = |N x l|; 0 where N is undefined.
/// Differs from Eq. (8): N = n' x n''/|n' x n''| is normalised; as printed, omega_1 of opposite normals is 0.
HWY_INLINE VF omega_1(const Vec3& n1, const Vec3& n2, const Vec3& l) {
  const Vec3 n = cross(n1, n2), sine = cross(n, l);
  const VF square = dot(sine, sine);
  // |n x l|/|n| with one root
  return hn::Mul(square, reciprocal_sqrt(hn::Max(hn::Mul(square, dot(n, n)), set(1e-36f))));
}

/// The score of the plane with unit normal `gamma`: `in_front` are the sums over one side of it (the paper's
/// '), `all` those over the window without its centre.
HWY_INLINE VF plane_score(const Centres& centres, const Vec3& gamma, const HalfSums& in_front,
                          const HalfSums& all) {
  const Half front = half_of(in_front, centres), back = half_of(all, centres) - front;
  const VF one = set(1.0f), half = set(0.5f);
  // Eq. (5)
  const Vec3 p1 = front.point * reciprocal(hn::Max(front.count, one));
  // Eq. (6)
  const Vec3 p2 = back.point * reciprocal(hn::Max(back.count, one));
  const Vec3 difference = p1 - p2;
  const MF halves = hn::And(hn::Gt(front.count, half), hn::Gt(back.count, half));
  // Eq. (14), as meant: the normals lean away from the plane. As printed it also erases convex patches. The
  // signs show before anything is normalised, and at most pixels one plane or more needs no further work.
  const MF good = hn::And(halves, hn::And(hn::Gt(dot(front.normal, difference), zero()),
                                          hn::Lt(dot(back.normal, difference), zero())));
  if (hn::AllFalse(df, good)) return zero();

  // Eq. (10)
  const Vec3 n1 = normalised(front.normal);
  // Eq. (11)
  const Vec3 n2 = normalised(back.normal);
  // Eq. (9)
  const Vec3 l = normalised(difference);
  // Eq. (4)
  const VF delta_D = hn::Abs(difference.z);
  // Eq. (7), since gamma.p1 and gamma.p2 have opposite signs
  const VF delta_d = hn::Abs(dot(gamma, p1 + p2));
  // Eq. (12): (1 - cos(a1 + a2))(1 - cos(a1 - a2)) = (cos a1 - cos a2)^2
  const VF difference_of_cosines = hn::Sub(dot(n1, l), dot(n2, l));
  const VF omega_2 = hn::Mul(difference_of_cosines, difference_of_cosines);
  // Eq. (3), Eq. (13)
  const VF exponent = hn::Mul(hn::Add(delta_D, delta_d), centres.minus_inverse_lambda);
  const VF distance = hn::Exp(df, exponent);
  return hn::IfThenElseZero(good, hn::Mul(hn::Mul(distance, omega_1(n1, n2, l)), omega_2));
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
