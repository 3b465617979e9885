// Entries of RowPrefixSums; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_ROW_PREFIX_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_ROW_PREFIX_SUMS_INL
#undef SACCADE_SALIENCY_ROW_PREFIX_SUMS_INL
#else
#define SACCADE_SALIENCY_ROW_PREFIX_SUMS_INL
#endif

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_prefix_sums.hpp"
#include "saliency/simd/vectors-inl.hpp"
#include "saliency/simd/window_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// A sum over kNumbers consecutive numbers of entries.
template <int kNumbers>
class PartSum {
 public:
  HWY_INLINE PartSum() {
    for (auto& part : parts_) part = hn::Zero(kTag);
  }
  HWY_INLINE void add(const std::int32_t* entry) {
    for (int i = 0; i < kParts; ++i) parts_[i] = hn::Add(parts_[i], hn::Load(kTag, entry + i * kPartLanes));
  }
  HWY_INLINE void subtract(const std::int32_t* entry) {
    for (int i = 0; i < kParts; ++i) parts_[i] = hn::Sub(parts_[i], hn::Load(kTag, entry + i * kPartLanes));
  }
  HWY_INLINE void store(std::int32_t* entry) const {
    for (int i = 0; i < kParts; ++i) hn::Store(parts_[i], kTag, entry + i * kPartLanes);
  }

 private:
  using Tag = hn::CappedTag<std::int32_t, kNumbers>;
  static constexpr Tag kTag{};
  static constexpr int kPartLanes = HWY_MIN(kNumbers, HWY_LANES(std::int32_t));
  static constexpr int kParts = kNumbers / kPartLanes;
  hn::Vec<Tag> parts_[kParts];
};

using EntrySum = PartSum<RowPrefixSums::kNumbers>;

HWY_INLINE const std::int32_t* entry_at(const char* base, std::int32_t offset) {
  return reinterpret_cast<const std::int32_t*>(base + offset);
}

/// Computes the entries of row r.
HWY_INLINE void fill_prefix_row(const LevelPlanes& level, int r, int reach, RowPrefixSums& row_sums) {
  constexpr int kHalf = RowPrefixSums::kNumbers / 2;
  const VF unit = set(normal_units(reach));
  const VI depth_mask = hn::Set(di, level.packing.depth_mask()), row = hn::Set(di, r);
  const float* packed = level.row(LevelPlanes::kPacked, r);
  alignas(64) std::int32_t first[kHalf * kLanes], second[kHalf * kLanes];
  PartSum<kHalf> first_sum, second_sum;
  const auto store = [&](int c) HWY_ATTR {
    first_sum.store(row_sums.at(r, c));
    second_sum.store(row_sums.at(r, c) + kHalf);
  };
  for (int c = -reach; c <= 0; ++c) store(c);
  const int end = round_up(level.width(), kLanes);
  for (int c = 0; c < end; c += kLanes) {
    const VI p = hn::BitCast(di, hn::Load(df, packed + c)), z = hn::And(p, depth_mask);
    const VI count = hn::IfThenElseZero(hn::Gt(p, hn::Zero(di)), hn::Set(di, 1));
    const auto normal = [&](LevelPlanes::Plane plane) HWY_ATTR {
      return nearest(hn::Mul(hn::Load(df, level.row(plane, r) + c), unit));
    };
    hn::StoreInterleaved4(count, z, hn::Mul(z, row), hn::Mul(z, hn::Iota(di, c)), di, first);
    hn::StoreInterleaved4(normal(LevelPlanes::kNormalX), normal(LevelPlanes::kNormalY),
                          normal(LevelPlanes::kNormalZ), hn::Zero(di), di, second);
    for (int lane = 0; lane < kLanes; ++lane) {
      first_sum.add(first + kHalf * lane);
      second_sum.add(second + kHalf * lane);
      store(c + lane + 1);
    }
  }
  for (int c = end + 1; c <= end + reach; ++c) store(c);
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
