#include "attention/simd/cell_means.hpp"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "attention/simd/cell_means.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "attention/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

// Row v of the pixels of a vector of cells, each pixel of a cell in a vector of its own.
template <typename D>
HWY_INLINE std::array<hn::VFromD<D>, kCellPx> load_pixels(D d, const PixelRows& rows, std::size_t v,
                                                          std::size_t cell) {
  const auto zero = hn::Zero(d);
  std::array<hn::VFromD<D>, kCellPx> pixel{zero, zero, zero, zero};
  hn::LoadInterleaved4(d, rows[v] + kCellPx * cell, pixel[0], pixel[1], pixel[2], pixel[3]);
  return pixel;
}

void mean_depths(const PixelRows& rows, float same_surface, float* depth, std::size_t cells) {
  for_lanes(0, cells, [&](auto d, std::size_t c) HWY_ATTR {
    const auto r0 = load_pixels(d, rows, 0, c), r1 = load_pixels(d, rows, 1, c),
               r2 = load_pixels(d, rows, 2, c), r3 = load_pixels(d, rows, 3, c);
    const auto lowest = [&](std::size_t u)
                            HWY_ATTR { return hn::Min(hn::Min(r0[u], r1[u]), hn::Min(r2[u], r3[u])); };
    const auto highest = [&](std::size_t u)
                             HWY_ATTR { return hn::Max(hn::Max(r0[u], r1[u]), hn::Max(r2[u], r3[u])); };
    const auto sum = [&](std::size_t u)
                         HWY_ATTR { return hn::Add(hn::Add(r0[u], r1[u]), hn::Add(r2[u], r3[u])); };
    const auto low = hn::Min(hn::Min(lowest(0), lowest(1)), hn::Min(lowest(2), lowest(3)));
    const auto high = hn::Max(hn::Max(highest(0), highest(1)), hn::Max(highest(2), highest(3)));
    const auto all = hn::Add(hn::Add(sum(0), sum(1)), hn::Add(sum(2), sum(3)));
    const auto zero = hn::Zero(d);
    const auto one_surface =
        hn::And(hn::Gt(low, zero), hn::Le(hn::Sub(high, low), hn::Mul(hn::Set(d, same_surface), low)));
    const auto otherwise = hn::IfThenElseZero(hn::Gt(high, zero), hn::Set(d, kMixedDepth));
    const auto mean = hn::Mul(all, hn::Set(d, 1.0F / (kCellPx * kCellPx)));
    hn::StoreU(hn::IfThenElse(one_surface, mean, otherwise), d, depth + c);
  });
}

void mean_values(const PixelRows& rows, float* mean, std::size_t cells) {
  for_lanes(0, cells, [&](auto d, std::size_t c) HWY_ATTR {
    const auto share = hn::Set(d, 1.0F / (kCellPx * kCellPx));
    auto sum = hn::Zero(d);
    for (std::size_t v = 0; v < kCellPx; ++v) {
      const auto s = load_pixels(d, rows, v, c);
      sum = hn::Add(sum, hn::Mul(hn::Add(hn::Add(s[0], s[1]), hn::Add(s[2], s[3])), share));
    }
    hn::StoreU(sum, d, mean + c);
  });
}

void add_weighted(std::span<const float* const> rows, std::span<const float> weights, float* out,
                  std::size_t count) {
  for_lanes(0, count, [&](auto d, std::size_t i) HWY_ATTR {
    auto sum = hn::Mul(hn::LoadU(d, rows[0] + i), hn::Set(d, weights[0]));
    for (std::size_t k = 1; k < rows.size(); ++k)
      sum = hn::Add(sum, hn::Mul(hn::LoadU(d, rows[k] + i), hn::Set(d, weights[k])));
    hn::StoreU(sum, d, out + i);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(mean_depths);
HWY_EXPORT(mean_values);
HWY_EXPORT(add_weighted);
}  // namespace

void mean_depths(const PixelRows& rows, float same_surface, float* depth, std::size_t cells) {
  HWY_DYNAMIC_DISPATCH(mean_depths)(rows, same_surface, depth, cells);
}

void mean_values(const PixelRows& rows, float* mean, std::size_t cells) {
  HWY_DYNAMIC_DISPATCH(mean_values)(rows, mean, cells);
}

void add_weighted(std::span<const float* const> rows, std::span<const float> weights, float* out,
                  std::size_t count) {
  HWY_DYNAMIC_DISPATCH(add_weighted)(rows, weights, out, count);
}

}  // namespace saccade
#endif  // HWY_ONCE
