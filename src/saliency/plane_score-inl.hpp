// What one candidate plane says, once the sums of its halves are known: Eqs. (3) to (14), compiled once for
// each instruction set.
#if defined(SACCADE_SALIENCY_PLANE_SCORE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_PLANE_SCORE_INL
#undef SACCADE_SALIENCY_PLANE_SCORE_INL
#else
#define SACCADE_SALIENCY_PLANE_SCORE_INL
#endif

#include <hwy/contrib/math/math-inl.h>

#include "saliency/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Sums over points of a window, whose centre is p at (row, col): count, z - p.z in mm, z times the rows and
/// columns from the centre, and normals.
struct HalfSums {
  V count, z, z_rows, z_cols;
  Vec3 normal;
};

HWY_INLINE HalfSums operator-(const HalfSums& a, const HalfSums& b) {
  return {hn::Sub(a.count, b.count), hn::Sub(a.z, b.z), hn::Sub(a.z_rows, b.z_rows),
          hn::Sub(a.z_cols, b.z_cols), a.normal - b.normal};
}

/// The pixels at whose points planes are judged.
struct Centres {
  V ray_x, ray_y;          ///< p = z * (ray_x, ray_y, 1)
  V minus_inverse_lambda;  ///< -1/lambda, 1/mm
  float inverse_fx, inverse_fy;
};

/// The mean point of a half, relative to p, Eqs. (5) and (6).
/// x_j - p.x = ray_x*(z_j - p.z) + z_j*dc/fx, and y alike.
HWY_INLINE Vec3 mean_point(const HalfSums& half, const Centres& centres, V inverse_count) {
  const V x = hn::MulAdd(centres.ray_x, half.z, hn::Mul(half.z_cols, set(centres.inverse_fx)));
  const V y = hn::MulAdd(centres.ray_y, half.z, hn::Mul(half.z_rows, set(centres.inverse_fy)));
  return Vec3{x, y, half.z} * inverse_count;
}

/// v/|v|, or v itself where it is (nearly) 0; `m` keeps the lanes where it is not.
HWY_INLINE Vec3 normalised(const Vec3& v, M& m) {
  const V square = dot(v, v);
  const M defined = hn::Gt(square, set(1e-30f));
  m = hn::And(m, defined);
  return v * reciprocal_sqrt(hn::IfThenElse(defined, square, set(1.0f)));
}

/// omega_1 of Eq. (8): |N x l| with N = n' x n''/|n' x n''|; 0 where N is not defined.
/// Differs from Eq. (8): N is normalised; without that omega_1 would vanish for exactly opposite normals.
HWY_INLINE V omega_1(const Vec3& n1, const Vec3& n2, const Vec3& l) {
  M defined = hn::Eq(zero(), zero());
  const Vec3 n = normalised(cross(n1, n2), defined);
  const Vec3 sine = cross(n, l);
  const V square = dot(sine, sine);
  const V tiny = set(1e-30f);
  return hn::IfThenElseZero(hn::And(defined, hn::Gt(square, tiny)),
                            hn::Mul(square, reciprocal_sqrt(hn::Max(square, tiny))));
}

/// Eqs. (3, 13) for one plane with unit normal `gamma`: `front` (the paper's ') is one side of it, `all` is
/// the window without its centre.
HWY_INLINE V plane_score(const Centres& centres, const Vec3& gamma, const HalfSums& front,
                         const HalfSums& all) {
  const HalfSums back = all - front;
  const V one = set(1.0f), half = set(0.5f);
  const Vec3 p1 = mean_point(front, centres, reciprocal(hn::Max(front.count, one)));  // Eq. (5)
  const Vec3 p2 = mean_point(back, centres, reciprocal(hn::Max(back.count, one)));    // Eq. (6)
  const Vec3 difference = p1 - p2;
  M good = hn::And(hn::Gt(front.count, half), hn::Gt(back.count, half));
  // Differs from Eq. (14), which as printed would also erase convex patches: the normals must lean away. That
  // is seen before anything is normalised, and at most pixels it spares the rest for one plane or more.
  good = hn::And(good, hn::And(hn::Gt(dot(front.normal, difference), zero()),
                               hn::Lt(dot(back.normal, difference), zero())));
  if (hn::AllFalse(kF, good)) return zero();

  const Vec3 n1 = normalised(front.normal, good);  // Eq. (10)
  const Vec3 n2 = normalised(back.normal, good);   // Eq. (11)
  const Vec3 l = normalised(difference, good);     // Eq. (9)
  const V delta_D = hn::Abs(difference.z);         // Eq. (4)
  const V delta_d = hn::Abs(dot(gamma, p1 + p2));  // Eq. (7), since gamma.p1 and gamma.p2 have two signs
  const V difference_of_cosines = hn::Sub(dot(n1, l), dot(n2, l));
  // Eq. (12): (1 - cos(a1 + a2))(1 - cos(a1 - a2)) is the same for angles of one plane.
  const V omega_2 = hn::Mul(difference_of_cosines, difference_of_cosines);
  const V exponent = hn::Mul(hn::Add(delta_D, delta_d), centres.minus_inverse_lambda);
  const V distance = hn::Exp(kF, exponent);
  return hn::IfThenElseZero(good, hn::Mul(hn::Mul(distance, omega_1(n1, n2, l)), omega_2));
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
