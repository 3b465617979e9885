#include "models/grey_pairs.hpp"

#include <cstddef>

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "models/grey_pairs.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// All pairs about the columns from c on, as many as a vector of `d` has. Nothing is fused, so that each
// instruction set rounds alike.
template <typename D>
void add_pairs_at(D d, const std::vector<MirrorPair>& pairs, const std::vector<GreyPairRows>& rows,
                  float* score, std::size_t c) {
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  auto sum = hn::LoadU(d, score + c);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const MirrorPair& pair = pairs[k];
    const GreyPairRows& row = rows[k];
    const auto ci = hn::LoadU(d, row.cos_i + c), si = hn::LoadU(d, row.sin_i + c);
    const auto cj = hn::LoadU(d, row.cos_j + c), sj = hn::LoadU(d, row.sin_j + c);
    const auto cc = hn::Mul(ci, cj), ss = hn::Mul(si, sj);
    const auto sc = hn::Add(hn::Mul(si, cj), hn::Mul(ci, sj));
    const auto both =
        hn::Add(hn::Mul(hn::Sub(cc, ss), hn::Set(d, pair.cos2a)), hn::Mul(sc, hn::Set(d, pair.sin2a)));
    const auto mirrored = hn::Max(zero, hn::Sub(one, both));            // 1 - cos(ti + tj - 2 alpha)
    const auto opposed = hn::Max(zero, hn::Sub(one, hn::Add(cc, ss)));  // 1 - cos(ti - tj)
    const auto strength = hn::Mul(hn::Mul(hn::LoadU(d, row.strength_i + c), hn::LoadU(d, row.strength_j + c)),
                                  hn::Set(d, pair.weight));
    sum = hn::Add(sum, hn::Mul(hn::Mul(mirrored, opposed), strength));
  }
  hn::StoreU(sum, d, score + c);
}

void add_grey_pairs(const std::vector<MirrorPair>& pairs, const std::vector<GreyPairRows>& rows, float* score,
                    std::size_t width) {
  const hn::ScalableTag<float> d;
  std::size_t c = 0;
  for (; c + hn::Lanes(d) <= width; c += hn::Lanes(d)) add_pairs_at(d, pairs, rows, score, c);
  for (; c < width; ++c) add_pairs_at(hn::CappedTag<float, 1>(), pairs, rows, score, c);
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace saccade {
namespace {
HWY_EXPORT(add_grey_pairs);
}  // namespace

void add_grey_pairs(const std::vector<MirrorPair>& pairs, const std::vector<GreyPairRows>& rows, float* score,
                    int width) {
  HWY_DYNAMIC_DISPATCH(add_grey_pairs)(pairs, rows, score, static_cast<std::size_t>(width));
}

}  // namespace saccade
#endif  // HWY_ONCE
