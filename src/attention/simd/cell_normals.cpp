#include "attention/simd/cell_normals.hpp"

#include <array>

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "attention/simd/cell_normals.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "attention/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Sums of the least-squares fit of w = slope_u*u + slope_v*v + c, over the cells of a window that are of the
/// middle's surface: u, v from the middle, w the inverse depth less that of the middle.
template <typename V>
struct FitSums {
  V n, u, v, uu, vv, uv, w, uw, vw;
};

// Sums over u come first, then those over v. u and v are integers, so only the sums of w are rounded.
template <typename D, typename V = hn::VFromD<D>>
HWY_INLINE FitSums<V> sum_fit(D d, const FramedCells& cells, std::size_t corner, V z0, V w0, V reach) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  FitSums<V> s{zero, zero, zero, zero, zero, zero, zero, zero, zero};
  for (int v = -kNormalReach; v <= kNormalReach; ++v, corner += cells.stride) {
    std::array<V, 2 * kNormalReach + 1> use{zero, zero, zero, zero, zero}, w = use;
    for (std::size_t u = 0; u < use.size(); ++u) {
      const auto same = hn::Le(hn::Abs(hn::Sub(hn::LoadU(d, cells.depth + corner + u), z0)), reach);
      use[u] = hn::IfThenElseZero(same, one);
      w[u] = hn::IfThenElseZero(same, hn::Sub(hn::LoadU(d, cells.inverse + corner + u), w0));
    }
    const V outer = hn::Add(use[0], use[4]), inner = hn::Add(use[1], use[3]);
    const V row_n = hn::Add(hn::Add(outer, inner), use[2]);
    const V end_u = hn::Sub(use[4], use[0]), row_u = hn::Add(hn::Add(end_u, end_u), hn::Sub(use[3], use[1]));
    const V two_uu = hn::Add(outer, outer), row_uu = hn::Add(hn::Add(two_uu, two_uu), inner);
    const V row_w = hn::Add(hn::Add(hn::Add(w[0], w[4]), hn::Add(w[1], w[3])), w[2]);
    const V end_w = hn::Sub(w[4], w[0]), row_uw = hn::Add(hn::Add(end_w, end_w), hn::Sub(w[3], w[1]));
    const V y = hn::Set(d, static_cast<float>(v));
    s.n = hn::Add(s.n, row_n), s.u = hn::Add(s.u, row_u), s.uu = hn::Add(s.uu, row_uu);
    s.v = hn::Add(s.v, hn::Mul(y, row_n)), s.vv = hn::Add(s.vv, hn::Mul(hn::Mul(y, y), row_n));
    s.uv = hn::Add(s.uv, hn::Mul(y, row_u));
    s.w = hn::Add(s.w, row_w), s.uw = hn::Add(s.uw, row_uw), s.vw = hn::Add(s.vw, hn::Mul(y, row_w));
  }
  return s;
}

template <typename D>
HWY_INLINE void find_normals_at(D d, const FramedCells& cells, const Intrinsics& camera, float same_surface,
                                std::size_t row, std::size_t col, const NormalRows& normals) {
  using V = hn::VFromD<D>;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  const std::size_t corner = row * cells.stride + col,
                    middle = corner + kNormalReach * cells.stride + kNormalReach;
  const V z0 = hn::LoadU(d, cells.depth + middle), w0 = hn::LoadU(d, cells.inverse + middle);
  const auto store = [&](V x, V y, V z) HWY_ATTR {
    hn::StoreU(x, d, normals.x + col), hn::StoreU(y, d, normals.y + col), hn::StoreU(z, d, normals.z + col);
  };
  const auto has_depth = hn::Gt(z0, zero);
  if (hn::AllFalse(d, has_depth)) return store(zero, zero, zero);
  const FitSums<V> s = sum_fit(d, cells, corner, z0, w0, hn::Mul(z0, hn::Set(d, same_surface)));

  const V uu = hn::Sub(hn::Mul(s.n, s.uu), hn::Mul(s.u, s.u)),
          vv = hn::Sub(hn::Mul(s.n, s.vv), hn::Mul(s.v, s.v)),
          uv = hn::Sub(hn::Mul(s.n, s.uv), hn::Mul(s.u, s.v)),
          uw = hn::Sub(hn::Mul(s.n, s.uw), hn::Mul(s.u, s.w)),
          vw = hn::Sub(hn::Mul(s.n, s.vw), hn::Mul(s.v, s.w));
  const V determinant = hn::Sub(hn::Mul(uu, vv), hn::Mul(uv, uv));
  const auto fits = hn::And(has_depth, hn::And(hn::Ge(s.n, hn::Set(d, 6.0F)), hn::Gt(determinant, zero)));
  const V divisor = hn::IfThenElse(fits, determinant, one);
  const V slope_u = hn::Div(hn::Sub(hn::Mul(uw, vv), hn::Mul(vw, uv)), divisor),
          slope_v = hn::Div(hn::Sub(hn::Mul(vw, uu), hn::Mul(uw, uv)), divisor);
  const V offset = hn::Sub(hn::Sub(s.w, hn::Mul(slope_u, s.u)), hn::Mul(slope_v, s.v));
  const V at_middle = hn::Add(w0, hn::Div(offset, hn::Max(s.n, one)));

  // The plane 1/z = a*x + b*y + c over the rays (x, y, 1); its normal is (a, b, c).
  const V cols_off = hn::Sub(hn::Iota(d, static_cast<float>(col)), hn::Set(d, static_cast<float>(camera.cx))),
          rows_off = hn::Set(d, static_cast<float>(row) - static_cast<float>(camera.cy));
  const V a = hn::Mul(slope_u, hn::Set(d, static_cast<float>(camera.fx))),
          b = hn::Mul(slope_v, hn::Set(d, static_cast<float>(camera.fy))),
          c = hn::Sub(hn::Sub(at_middle, hn::Mul(slope_u, cols_off)), hn::Mul(slope_v, rows_off));
  const V squares = hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(c, c));
  const V scale = hn::Div(hn::Set(d, -1.0F), hn::Sqrt(hn::IfThenElse(fits, squares, one)));
  store(hn::IfThenElseZero(fits, hn::Mul(a, scale)), hn::IfThenElseZero(fits, hn::Mul(b, scale)),
        hn::IfThenElseZero(fits, hn::Mul(c, scale)));
}

void find_normals(const FramedCells& cells, const Intrinsics& camera, float same_surface, std::size_t row,
                  std::size_t cols, const NormalRows& normals) {
  for_lanes(0, cols, [&](auto d, std::size_t col) HWY_ATTR {
    find_normals_at(d, cells, camera, same_surface, row, col, normals);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(find_normals);
}  // namespace

void find_normals(const FramedCells& cells, const Intrinsics& camera, float same_surface, std::size_t row,
                  std::size_t cols, const NormalRows& normals) {
  HWY_DYNAMIC_DISPATCH(find_normals)(cells, camera, same_surface, row, cols, normals);
}

}  // namespace saccade
#endif  // HWY_ONCE
