// Sums over the window of each pixel of a row, slid from row to row; compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_WINDOW_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_WINDOW_SUMS_INL
#undef SACCADE_SALIENCY_WINDOW_SUMS_INL
#else
#define SACCADE_SALIENCY_WINDOW_SUMS_INL
#endif

#include <algorithm>
#include <bit>

#include "saliency/level_planes.hpp"
#include "saliency/row_scratch.hpp"
#include "saliency/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Normals and their products are summed in units of 2^-bits, as fine as 32 bits allow for a window's points.
inline int normal_bits(int reach) {
  const unsigned points = static_cast<unsigned>((2 * reach + 1) * (2 * reach + 1));
  return 31 - static_cast<int>(std::bit_width(points));
}

HWY_INLINE void accumulate(std::int32_t* sum, V value, float sign) {
  const auto whole = hn::NearestInt(value);
  const auto old = hn::Load(kWhole, sum);
  hn::Store(sign > 0 ? hn::Add(old, whole) : hn::Sub(old, whole), kWhole, sum);
}

/// Adds (sign = 1) or takes away (-1) row r, which lies `dr` rows from the centre, to the sums of each
/// column.
HWY_INLINE void accumulate_row(const LevelPlanes& level, int r, int dr, float sign, float unit,
                               WindowSums& columns, double* depth) {
  const float* nx = level.row(LevelPlanes::kNormalX, r);
  const float* ny = level.row(LevelPlanes::kNormalY, r);
  const float* nz = level.row(LevelPlanes::kNormalZ, r);
  std::int32_t* sums[WindowSums::kWholes];
  for (int i = 0; i < WindowSums::kWholes; ++i) sums[i] = columns.whole[static_cast<std::size_t>(i)].data();
  for (int c = 0; c < level.width(); c += kLanes) {
    const V x = hn::Load(kF, nx + c), y = hn::Load(kF, ny + c), z = hn::Load(kF, nz + c);
    const V ux = hn::Mul(x, set(unit)), uy = hn::Mul(y, set(unit)), uz = hn::Mul(z, set(unit));
    accumulate(sums[WindowSums::kX] + c, ux, sign);
    accumulate(sums[WindowSums::kY] + c, uy, sign);
    accumulate(sums[WindowSums::kZ] + c, uz, sign);
    accumulate(sums[WindowSums::kXX] + c, hn::Mul(ux, x), sign);
    accumulate(sums[WindowSums::kYY] + c, hn::Mul(uy, y), sign);
    accumulate(sums[WindowSums::kZZ] + c, hn::Mul(uz, z), sign);
    accumulate(sums[WindowSums::kXY] + c, hn::Mul(ux, y), sign);
    accumulate(sums[WindowSums::kXZ] + c, hn::Mul(ux, z), sign);
    accumulate(sums[WindowSums::kYZ] + c, hn::Mul(uy, z), sign);
  }
  const auto* packed = reinterpret_cast<const std::int32_t*>(level.row(LevelPlanes::kPacked, r));
  const float* exact = level.row(LevelPlanes::kDepth, r);
  double* rounded_sum = columns.depth[WindowSums::kDepth].data();
  double* rows_sum = columns.depth[WindowSums::kDepthRows].data();
  const WideV one = hn::Set(kWide, static_cast<double>(1 << level.packing.depth_bits)),
              none = hn::Zero(kWide), factor = hn::Set(kWide, static_cast<double>(sign)),
              row_factor = hn::Set(kWide, static_cast<double>(sign) * dr);
  for (int c = 0; c < level.width(); c += kWideLanes) {
    const WideV p = hn::PromoteTo(kWide, hn::Load(kHalfWhole, packed + c));
    const auto usable = hn::Gt(p, none);
    const WideV z_units = hn::IfThenElseZero(usable, hn::Sub(p, one));
    const WideV z = hn::IfThenElseZero(usable, hn::PromoteTo(kWide, hn::Load(kHalfF, exact + c)));
    hn::Store(hn::MulAdd(factor, z_units, hn::Load(kWide, rounded_sum + c)), kWide, rounded_sum + c);
    hn::Store(hn::MulAdd(factor, z, hn::Load(kWide, depth + c)), kWide, depth + c);
    hn::Store(hn::MulAdd(row_factor, z, hn::Load(kWide, rows_sum + c)), kWide, rows_sum + c);
  }
}

/// The sums of each column of the window of row r; `first` if those of row r - 1 are not there.
HWY_INLINE void slide_column_sums(const LevelPlanes& level, int r, int reach, bool first,
                                  RowScratch& scratch) {
  const float unit = static_cast<float>(1 << normal_bits(reach));
  WindowSums& columns = scratch.columns;
  double* depth = scratch.column_depth.data();
  if (first) {
    const int width = level.width() + reach + kLanes;  // the margin too: the last level may have been wider
    for (auto& row : columns.whole) std::fill(row.data(), row.data() + width, 0);
    for (auto& row : columns.depth) std::fill(row.data(), row.data() + width, 0.0);
    std::fill(depth, depth + width, 0.0);
    for (int v = std::max(0, r - reach); v <= std::min(level.height() - 1, r + reach); ++v)
      accumulate_row(level, v, v - r, 1, unit, columns, depth);
    return;
  }
  // Each row is now one further up: its dr is one less.
  double* rows_sum = columns.depth[WindowSums::kDepthRows].data();
  for (int c = 0; c < level.width(); c += kWideLanes)
    hn::Store(hn::Sub(hn::Load(kWide, rows_sum + c), hn::Load(kWide, depth + c)), kWide, rows_sum + c);
  if (r - reach - 1 >= 0) accumulate_row(level, r - reach - 1, -reach - 1, -1, unit, columns, depth);
  if (r + reach < level.height()) accumulate_row(level, r + reach, reach, 1, unit, columns, depth);
}

/// box[c] = sum of row[c - reach .. c + reach] for every column, by doubling: sums of 1, 2, 4, ...
/// neighbours, of which those are added that make up the width. `row` holds 0 in its margins; `power` is
/// scratch.
template <typename T>
HWY_INLINE void sum_neighbours(const T* row, T* power, T* box, int width, int reach) {
  const hn::ScalableTag<T> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag)), size = 2 * reach + 1;
  const int begin = -round_up(reach, lanes), end = width + reach;
  for (int c = 0; c < width; c += lanes) hn::Store(hn::LoadU(tag, row + c - reach), tag, box + c);
  const T* source = row;  // sums of `span` neighbours
  int offset = 1 - reach;
  for (int span = 1; 2 * span <= size; span *= 2, source = power) {
    for (int c = begin; c < end; c += lanes)
      hn::Store(hn::Add(hn::Load(tag, source + c), hn::LoadU(tag, source + c + span)), tag, power + c);
    if ((size & (2 * span)) == 0) continue;
    for (int c = 0; c < width; c += lanes)
      hn::Store(hn::Add(hn::Load(tag, box + c), hn::LoadU(tag, power + c + offset)), tag, box + c);
    offset += 2 * span;
  }
}

/// From the sums of columns those of whole windows.
HWY_INLINE void sum_boxes(int width, int reach, RowScratch& scratch) {
  double* depth = scratch.columns.depth[WindowSums::kDepth].data();
  double* cols_sum = scratch.columns.depth[WindowSums::kDepthCols].data();
  for (int c = 0; c < width; c += kWideLanes)
    hn::Store(hn::Mul(hn::Load(kWide, depth + c), hn::Iota(kWide, static_cast<double>(c))), kWide,
              cols_sum + c);
  for (std::size_t i = 0; i < WindowSums::kWholes; ++i)
    sum_neighbours(scratch.columns.whole[i].data(), scratch.whole_doubling.data(),
                   scratch.boxes.whole[i].data(), width, reach);
  for (std::size_t i = 0; i < WindowSums::kDoubles; ++i)
    sum_neighbours(scratch.columns.depth[i].data(), scratch.double_doubling.data(),
                   scratch.boxes.depth[i].data(), width, reach);
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
