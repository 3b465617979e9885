#include "attention/simd/plane_cells.hpp"

#include <algorithm>
#include <array>

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "attention/simd/plane_cells.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "attention/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

template <typename V>
HWY_INLINE auto is_in_plane(V col, V row, V w, V a, V b, V c, V reach) {
  const auto at = hn::Add(hn::Add(hn::Mul(a, col), hn::Mul(b, row)), c);
  return hn::Le(hn::Abs(hn::Sub(at, w)), hn::Mul(reach, w));
}

// Counts the cells begin..end, a multiple of the lanes of `d`.
template <typename D>
HWY_INLINE int count_block(D d, const PlaneCells& cells, std::size_t begin, std::size_t end, float a, float b,
                           float c, float reach) {
  const hn::RebindToSigned<D> di;
  const auto va = hn::Set(d, a), vb = hn::Set(d, b), vc = hn::Set(d, c), vreach = hn::Set(d, reach);
  auto count = hn::Zero(di);  // less one for each cell in the plane
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const auto in = is_in_plane(hn::LoadU(d, cells.col + i), hn::LoadU(d, cells.row + i),
                                hn::LoadU(d, cells.w + i), va, vb, vc, vreach);
    count = hn::Add(count, hn::VecFromMask(di, hn::RebindMask(di, in)));
  }
  return -static_cast<int>(hn::GetLane(hn::SumOfLanes(di, count)));
}

int count_in_plane(const PlaneCells& cells, float a, float b, float c, float reach, int least) {
  constexpr std::size_t kBlock = 256;
  const hn::ScalableTag<float> d;
  static_assert(kBlock % hn::MaxLanes(d) == 0);
  const std::size_t whole = cells.count - cells.count % hn::Lanes(d);
  int count = 0;
  std::size_t i = 0;
  for (; i < whole; i = std::min(i + kBlock, whole)) {
    if (count + static_cast<int>(cells.count - i) <= least) return count;
    count += count_block(d, cells, i, std::min(i + kBlock, whole), a, b, c, reach);
  }
  return count + count_block(hn::CappedTag<float, 1>(), cells, i, cells.count, a, b, c, reach);
}

// Cell i goes to the sum i % kSums, and these are added in one order, so that the result does not depend on
// the size of vectors.
constexpr std::size_t kSums = 8;

struct PartialSums {
  alignas(64) std::array<std::array<double, kSums>, 9> of{};

  double all(std::size_t k) const {
    const auto& s = of[k];
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  }
};

// Adds cells first..first + lanes of `d` to the sums from `first` % kSums on.
template <typename D>
HWY_INLINE void add_in_plane(D d, const PlaneCells& cells, std::size_t first, double a, double b, double c,
                             double reach, PartialSums& sums) {
  const hn::Rebind<float, D> df;
  const auto u = hn::PromoteTo(d, hn::LoadU(df, cells.col + first)),
             v = hn::PromoteTo(d, hn::LoadU(df, cells.row + first)),
             w = hn::PromoteTo(d, hn::LoadU(df, cells.w + first));
  const auto in = is_in_plane(u, v, w, hn::Set(d, a), hn::Set(d, b), hn::Set(d, c), hn::Set(d, reach));
  const auto add = [&](std::size_t k, auto value) HWY_ATTR {
    double* const sum = sums.of[k].data() + first % kSums;
    hn::StoreU(hn::Add(hn::LoadU(d, sum), hn::IfThenElseZero(in, value)), d, sum);
  };
  add(0, hn::Set(d, 1.0)), add(1, u), add(2, v);
  add(3, hn::Mul(u, u)), add(4, hn::Mul(v, v)), add(5, hn::Mul(u, v));
  add(6, w), add(7, hn::Mul(u, w)), add(8, hn::Mul(v, w));
}

PlaneSums sum_in_plane(const PlaneCells& cells, double a, double b, double c, double reach) {
  const hn::CappedTag<double, kSums> d;
  PartialSums sums;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= cells.count; i += hn::Lanes(d)) add_in_plane(d, cells, i, a, b, c, reach, sums);
  for (; i < cells.count; ++i) add_in_plane(hn::CappedTag<double, 1>(), cells, i, a, b, c, reach, sums);
  return {sums.all(0), sums.all(1), sums.all(2), sums.all(3), sums.all(4),
          sums.all(5), sums.all(6), sums.all(7), sums.all(8)};
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(count_in_plane);
HWY_EXPORT(sum_in_plane);
}  // namespace

int count_in_plane(const PlaneCells& cells, float a, float b, float c, float reach, int least) {
  return HWY_DYNAMIC_DISPATCH(count_in_plane)(cells, a, b, c, reach, least);
}

PlaneSums sum_in_plane(const PlaneCells& cells, double a, double b, double c, double reach) {
  return HWY_DYNAMIC_DISPATCH(sum_in_plane)(cells, a, b, c, reach);
}

}  // namespace saccade
#endif  // HWY_ONCE
