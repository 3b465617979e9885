// Sums of points as PointRecords holds them, compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_POINT_RECORDS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_POINT_RECORDS_INL
#undef SACCADE_SALIENCY_POINT_RECORDS_INL
#else
#define SACCADE_SALIENCY_POINT_RECORDS_INL
#endif

#include "saliency/level_planes.hpp"
#include "saliency/point_records.hpp"
#include "saliency/simd-inl.hpp"
#include "saliency/window_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Some numbers of a record together.
template <int kNumbers>
class PartSum {
 public:
  HWY_INLINE PartSum() {
    for (auto& part : parts_) part = hn::Zero(kTag);
  }
  HWY_INLINE void add(const std::int32_t* record) {
    for (int i = 0; i < kParts; ++i) parts_[i] = hn::Add(parts_[i], hn::Load(kTag, record + i * kPartLanes));
  }
  HWY_INLINE void subtract(const std::int32_t* record) {
    for (int i = 0; i < kParts; ++i) parts_[i] = hn::Sub(parts_[i], hn::Load(kTag, record + i * kPartLanes));
  }
  HWY_INLINE void store(std::int32_t* record) const {
    for (int i = 0; i < kParts; ++i) hn::Store(parts_[i], kTag, record + i * kPartLanes);
  }

 private:
  using Tag = hn::CappedTag<std::int32_t, kNumbers>;
  static constexpr Tag kTag{};
  static constexpr int kPartLanes = HWY_MIN(kNumbers, HWY_LANES(std::int32_t));
  static constexpr int kParts = kNumbers / kPartLanes;
  hn::Vec<Tag> parts_[kParts];
};

using RecordSum = PartSum<PointRecords::kNumbers>;

HWY_INLINE const std::int32_t* record_at(const char* base, std::int32_t offset) {
  return reinterpret_cast<const std::int32_t*>(base + offset);
}

/// Fills the records of row r.
HWY_INLINE void record_row(const LevelPlanes& level, int r, int reach, PointRecords& records) {
  constexpr int kHalf = PointRecords::kNumbers / 2;
  const V unit = set(normal_units(reach));
  const W depth_mask = hn::Set(kWhole, level.packing.depth_mask()), row = hn::Set(kWhole, r);
  const float* packed = level.row(LevelPlanes::kPacked, r);
  alignas(64) std::int32_t first[kHalf * kLanes], second[kHalf * kLanes];
  PartSum<kHalf> first_sum, second_sum;
  const auto store = [&](int c) HWY_ATTR {
    first_sum.store(records.at(r, c));
    second_sum.store(records.at(r, c) + kHalf);
  };
  for (int c = -reach; c <= 0; ++c) store(c);
  const int end = round_up(level.width(), kLanes);
  for (int c = 0; c < end; c += kLanes) {
    const W p = hn::BitCast(kWhole, hn::Load(kF, packed + c)), z = hn::And(p, depth_mask);
    const W count = hn::IfThenElseZero(hn::Gt(p, hn::Zero(kWhole)), hn::Set(kWhole, 1));
    const auto normal = [&](LevelPlanes::Plane plane) HWY_ATTR {
      return nearest(hn::Mul(hn::Load(kF, level.row(plane, r) + c), unit));
    };
    hn::StoreInterleaved4(count, z, hn::Mul(z, row), hn::Mul(z, hn::Iota(kWhole, c)), kWhole, first);
    hn::StoreInterleaved4(normal(LevelPlanes::kNormalX), normal(LevelPlanes::kNormalY),
                          normal(LevelPlanes::kNormalZ), hn::Zero(kWhole), kWhole, second);
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
