// Sums over the windows of a row, updated from row to row; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_WINDOW_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_WINDOW_SUMS_INL
#undef SACCADE_SALIENCY_WINDOW_SUMS_INL
#else
#define SACCADE_SALIENCY_WINDOW_SUMS_INL
#endif

#include <algorithm>
#include <bit>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/row_scratch.hpp"
#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Normals and their products are summed as integers, in units of 1/normal_units(): the largest power of 2
/// for which a window's sum fits 32 bits.
inline float normal_units(int reach) {
  const unsigned points = static_cast<unsigned>((2 * reach + 1) * (2 * reach + 1));
  return static_cast<float>(1 << (31 - std::bit_width(points)));
}

/// Adds (sign = 1) the pixels at `at`, `dr` rows below the centre, to the sums of their columns, or subtracts
/// them (-1).
HWY_INLINE void add_pixels(const LevelPlanes& level, std::ptrdiff_t at, int dr, int sign, VF unit,
                           VI depth_mask, VI (&sums)[VerticalSums::kSums]) {
  using S = VerticalSums;
  const auto get = [&](LevelPlanes::Plane plane) HWY_ATTR { return hn::Load(df, level.plane(plane) + at); };
  const auto add = [&](S::Sum sum, VI value) HWY_ATTR {
    sums[sum] = sign > 0 ? hn::Add(sums[sum], value) : hn::Sub(sums[sum], value);
  };
  const VF x = get(LevelPlanes::kNormalX), y = get(LevelPlanes::kNormalY), z = get(LevelPlanes::kNormalZ);
  const VF ux = hn::Mul(x, unit), uy = hn::Mul(y, unit), uz = hn::Mul(z, unit);
  add(S::kX, nearest(ux));
  add(S::kY, nearest(uy));
  add(S::kZ, nearest(uz));
  add(S::kXX, nearest(hn::Mul(ux, x)));
  add(S::kYY, nearest(hn::Mul(uy, y)));
  add(S::kZZ, nearest(hn::Mul(uz, z)));
  add(S::kXY, nearest(hn::Mul(ux, y)));
  add(S::kXZ, nearest(hn::Mul(ux, z)));
  add(S::kYZ, nearest(hn::Mul(uy, z)));
  const VI packed = hn::BitCast(di, get(LevelPlanes::kPacked));
  add(S::kPacked, packed);
  add(S::kDepthRows, hn::Mul(hn::And(packed, depth_mask), hn::Set(di, dr)));
}

/// VerticalSums of row r; from those of row r - 1 unless `first`.
HWY_INLINE void slide_vertical_sums(const LevelPlanes& level, int r, int reach, bool first,
                                    RowScratch& scratch) {
  const VF unit = set(normal_units(reach));
  const VI depth_mask = hn::Set(di, level.packing.depth_mask());
  for (int c = 0; c < level.width() + reach; c += kLanes) {
    VI sums[VerticalSums::kSums];
    const auto add_row = [&](int row, int sign) HWY_ATTR {
      if (row >= 0 && row < level.height())
        add_pixels(level, level.at(row, c), row - r, sign, unit, depth_mask, sums);
    };
    if (first) {
      for (VI& sum : sums) sum = hn::Zero(di);
      for (int row = r - reach; row <= r + reach; ++row) add_row(row, 1);
    } else {
      for (std::size_t i = 0; i < VerticalSums::kSums; ++i)
        sums[i] = hn::Load(di, scratch.vertical_sums.sums[i].data() + c);
      // The centre moved down, so each row is one further up.
      sums[VerticalSums::kDepthRows] =
          hn::Sub(sums[VerticalSums::kDepthRows], hn::And(sums[VerticalSums::kPacked], depth_mask));
      add_row(r - reach - 1, -1);
      add_row(r + reach, 1);
    }
    for (std::size_t i = 0; i < VerticalSums::kSums; ++i)
      hn::Store(sums[i], di, scratch.vertical_sums.sums[i].data() + c);
  }
}

/// `before` plus the prefix sums of the lanes; adds the sum of all lanes to `before`.
template <class Tag>
HWY_INLINE hn::Vec<Tag> prefix_sum(Tag tag, hn::Vec<Tag> v, hn::Vec<Tag>& before) {
  constexpr hn::RebindToSigned<Tag> index_tag;
  constexpr int lanes = HWY_LANES(hn::TFromD<Tag>);
  const auto index = hn::Iota(index_tag, 0);
  for (int step = 1; step < lanes; step *= 2) {
    const auto has = hn::RebindMask(tag, hn::Gt(index, hn::Set(index_tag, step - 1)));
    const auto from = hn::And(hn::Sub(index, hn::Set(index_tag, step)), hn::Set(index_tag, lanes - 1));
    v = hn::Add(v, hn::IfThenElseZero(has, hn::TableLookupLanes(v, hn::IndicesFromVec(tag, from))));
  }
  const auto last = hn::IndicesFromVec(tag, hn::Set(index_tag, lanes - 1));
  const auto total = hn::Add(v, before);
  before = hn::Add(before, hn::TableLookupLanes(v, last));
  return total;
}

/// WindowPrefixSums of VerticalSums, up to the last column of the last window.
HWY_INLINE void prefix_vertical_sums(const LevelPlanes& level, int reach, RowScratch& scratch) {
  using S = VerticalSums;
  using T = WindowPrefixSums;
  const VI depth_mask = hn::Set(di, level.packing.depth_mask());
  const auto columns = [&](int sum) {
    return scratch.vertical_sums.sums[static_cast<std::size_t>(sum)].data();
  };
  VI integers[T::kIntegers];
  for (VI& sum : integers) sum = hn::Zero(di);
  VD depth_rows = hn::Zero(dd), depth_cols = hn::Zero(dd);
  for (int c = 0; c < level.width() + reach; c += kLanes) {
    const auto put = [&](int i, VI sum) HWY_ATTR {
      hn::Store(prefix_sum(di, sum, integers[i]), di,
                scratch.window_sums.integers[static_cast<std::size_t>(i)].data() + c);
    };
    for (int i = 0; i < S::kNormals; ++i) put(i, hn::Load(di, columns(i) + c));
    put(T::kDepth, hn::And(hn::Load(di, columns(S::kPacked) + c), depth_mask));
  }
  const auto half_mask = hn::Set(dhi, level.packing.depth_mask());
  for (int c = 0; c < level.width() + reach; c += kDoubleLanes) {
    const VD rows = hn::PromoteTo(dd, hn::Load(dhi, columns(S::kDepthRows) + c));
    const VD depth = hn::PromoteTo(dd, hn::And(hn::Load(dhi, columns(S::kPacked) + c), half_mask));
    const VD cols = hn::Mul(depth, hn::Iota(dd, static_cast<double>(c)));
    hn::Store(prefix_sum(dd, rows, depth_rows), dd, scratch.window_sums.doubles[T::kDepthRows].data() + c);
    hn::Store(prefix_sum(dd, cols, depth_cols), dd, scratch.window_sums.doubles[T::kDepthCols].data() + c);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
