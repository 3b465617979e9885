#include "attention/simd/cell_edges.hpp"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "attention/simd/cell_edges.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "attention/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

constexpr float kPerMetre = 1e-3F;  // 1/mm

template <typename V>
struct Vec3 {
  V x, y, z;
};

template <typename V>
HWY_INLINE Vec3<V> operator-(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <typename V>
HWY_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <typename D>
HWY_INLINE Vec3<hn::VFromD<D>> load_point(D d, const OrientedCells& cells, std::size_t i) {
  return {hn::LoadU(d, cells.x + i), hn::LoadU(d, cells.y + i), hn::LoadU(d, cells.z + i)};
}

template <typename D>
HWY_INLINE Vec3<hn::VFromD<D>> load_normal(D d, const OrientedCells& cells, std::size_t i) {
  return {hn::LoadU(d, cells.nx + i), hn::LoadU(d, cells.ny + i), hn::LoadU(d, cells.nz + i)};
}

// 1 where the mask is set, else 0.
template <typename D, typename M>
HWY_INLINE auto as_bytes(D, M mask) {
  const hn::RebindToSigned<D> di;
  const auto ones = hn::IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, 1));
  return hn::DemoteTo(hn::Rebind<std::uint8_t, D>(), ones);
}

void mark_concave(const OrientedCells& cells, std::size_t begin, std::size_t end, std::size_t step,
                  const ConcaveLimit& limit, std::uint8_t* marked) {
  for_lanes(begin, end, [&](auto d, std::size_t i) HWY_ATTR {
    const auto zero = hn::Zero(d), z = hn::LoadU(d, cells.z + i);
    const auto p = load_point(d, cells, i - step), q = load_point(d, cells, i + step), line = q - p;
    const auto n = load_normal(d, cells, i - step), m = load_normal(d, cells, i + step);
    const auto turn = dot(m - n, line);
    const auto farther = hn::Max(hn::Sub(hn::Mul(hn::Set(d, kPerMetre), z), hn::Set(d, 1.0F)), zero);
    const auto sine = hn::Add(hn::Set(d, limit.sine), hn::Mul(hn::Set(d, limit.sine_per_metre), farther));
    const auto away = hn::Max(hn::Abs(hn::Sub(p.z, z)), hn::Abs(hn::Sub(q.z, z)));
    const auto near = hn::Le(away, hn::Mul(hn::Set(d, limit.reach), z));
    const auto have_normals = hn::Gt(hn::Mul(n.z, m.z), zero);
    // turn < -sine * |line|, without the root
    const auto towards = hn::And(hn::Lt(turn, zero),
                                 hn::Gt(hn::Mul(turn, turn), hn::Mul(hn::Mul(sine, sine), dot(line, line))));
    const auto bytes = as_bytes(d, hn::And(hn::And(near, have_normals), towards));
    const hn::Rebind<std::uint8_t, decltype(d)> db;
    hn::StoreU(hn::Or(hn::LoadU(db, marked + i), bytes), db, marked + i);
  });
}

void find_linked(const OrientedCells& cells, std::size_t count, std::size_t step, float jump,
                 std::uint8_t* linked) {
  for_lanes(0, count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    const auto a = load_point(d, cells, i), b = load_point(d, cells, i + step), line = b - a;
    const auto n = load_normal(d, cells, i), m = load_normal(d, cells, i + step);
    const auto beyond = hn::Max(hn::Mul(hn::Set(d, kPerMetre), a.z), one);
    const auto limit = hn::Mul(hn::Mul(hn::Set(d, jump), a.z), beyond);
    const auto in_plane = [&](const auto& normal) HWY_ATTR {
      return hn::And(hn::Ne(normal.z, zero), hn::Lt(hn::Abs(dot(normal, line)), limit));
    };
    const auto one_surface = hn::Or(hn::Lt(hn::Abs(line.z), limit), hn::Or(in_plane(n), in_plane(m)));
    const auto valid = hn::Gt(hn::Min(a.z, b.z), zero);
    const hn::Rebind<std::uint8_t, decltype(d)> db;
    hn::StoreU(as_bytes(d, hn::And(valid, one_surface)), db, linked + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(mark_concave);
HWY_EXPORT(find_linked);
}  // namespace

void mark_concave(const OrientedCells& cells, std::size_t begin, std::size_t end, std::size_t step,
                  const ConcaveLimit& limit, std::uint8_t* marked) {
  HWY_DYNAMIC_DISPATCH(mark_concave)(cells, begin, end, step, limit, marked);
}

void find_linked(const OrientedCells& cells, std::size_t count, std::size_t step, float jump,
                 std::uint8_t* linked) {
  HWY_DYNAMIC_DISPATCH(find_linked)(cells, count, step, jump, linked);
}

}  // namespace saccade
#endif  // HWY_ONCE
