// The inner loop for large windows: the sums over the points in front of the candidate planes, section 2.2,
// from runs of points in rows. Compiled once for each instruction set.
#if defined(SACCADE_SALIENCY_RUNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SACCADE_SALIENCY_RUNS_INL
#undef SACCADE_SALIENCY_RUNS_INL
#else
#define SACCADE_SALIENCY_RUNS_INL
#endif

#include <algorithm>
#include <bit>
#include <cstring>

#include "saliency/simd/level_planes.hpp"
#include "saliency/simd/plane_score-inl.hpp"
#include "saliency/simd/row_prefix_sums-inl.hpp"
#include "saliency/simd/sweep-inl.hpp"
#include "saliency/simd/vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace saccade {
namespace HWY_NAMESPACE {

/// Windows of at least this reach are summed by runs, smaller ones point by point: at this one both take the
/// same time.
constexpr int kRunsFromReach = kLanes >= 16 ? 27 : kLanes >= 8 ? 11 : 7;

/// A part of a window, relative to its centre, of at most RowPrefixSums::kMostSide rows and columns.
struct Block {
  int first_row, rows, first_col, cols;
};

/// The centres of a vector: the lanes that are points, and the planes through them.
struct BlockCentres {
  int lanes[kLanes], count = 0;
  alignas(64) float z0[kLanes], per_col[kPlanes][kLanes], per_row[kPlanes][kLanes];

  BlockCentres(MF valid, const SweepPlanes& planes) {
    const unsigned bits = bits_of(valid);
    for (int lane = 0; lane < kLanes; ++lane)
      if (bits >> lane & 1) lanes[count++] = lane;
    hn::Store(planes.z0, df, z0);
    for (int i = 0; i < kPlanes; ++i) {
      hn::Store(planes.per_col[i], df, per_col[i]);
      hn::Store(planes.per_row[i], df, per_row[i]);
    }
  }
};

/// Neighbours in a row whose sides are found together.
constexpr int kChunk = 16;
static_assert(kChunk % kLanes == 0);

/// For each centre of a vector, the side of each plane on which the points of its block lie: bit i of
/// rows[plane][v][lane] is set if the point in column i and row v is in front.
struct Sides {
  static_assert(std::endian::native == std::endian::little);
  alignas(64) std::int32_t rows[kPlanes][RowPrefixSums::kMostSide][kLanes] = {};

  /// Sets the bits of a chunk that begins in column `first`.
  HWY_INLINE void set_chunk(int plane, int v, int lane, int first, unsigned bits) {
    const auto chunk = static_cast<std::uint16_t>(bits);
    std::memcpy(reinterpret_cast<char*>(&rows[plane][v][lane]) + first / 8, &chunk, sizeof chunk);
  }
};

/// Eq. (2) for the pixels of a block around one centre, in the form of sum_in_front(). The side of a pixel
/// without a point does not matter: it adds nothing to the prefix sums.
HWY_INLINE void find_sides(const LevelPlanes& level, std::ptrdiff_t at, const Block& block,
                           const BlockCentres& centres, int lane, Sides& sides) {
  constexpr int kVectors = kChunk / kLanes;
  const std::ptrdiff_t stride = level.stride();
  const VF z0 = set(centres.z0[lane]);
  VF per_row[kPlanes];
  for (int i = 0; i < kPlanes; ++i) per_row[i] = set(centres.per_row[i][lane]);
  for (int first = 0; first < block.cols; first += kChunk) {
    VF at_col[kPlanes][kVectors];
    for (int u = 0; u < kVectors; ++u) {
      const VF dc = hn::Iota(df, static_cast<float>(block.first_col + first + u * kLanes));
      for (int i = 0; i < kPlanes; ++i) at_col[i][u] = hn::Mul(set(centres.per_col[i][lane]), dc);
    }
    const std::ptrdiff_t begin = at + lane + block.first_row * stride + block.first_col + first;
    const float* depth = level.plane(LevelPlanes::kDepth) + begin;
    const float* inverse = level.plane(LevelPlanes::kInverse) + begin;
    const float* row = kNumbers.value + kNumbers.kLargest + block.first_row;
    for (int v = 0; v < block.rows; ++v, depth += stride, inverse += stride) {
      const VF dr = set(row[v]);
      unsigned bits[kPlanes] = {};
      for (int u = 0; u < kVectors; ++u) {
        const VF q = in_register(hn::Mul(hn::Sub(load(depth + u * kLanes), z0), load(inverse + u * kLanes)));
        for (int i = 0; i < kPlanes; ++i)
          bits[i] |= bits_of(hn::Gt(q, hn::MulAdd(per_row[i], dr, at_col[i][u]))) << (u * kLanes);
      }
      for (int i = 0; i < kPlanes; ++i) sides.set_chunk(i, v, lane, first, bits[i]);
    }
  }
}

/// The entries of RowPrefixSums at a block: the one of the first column and row v of the first lane's block
/// is row_offset[v] bytes from base, those of the other lanes follow.
struct BlockPrefixSums {
  const char* base;
  std::int32_t row_offset[RowPrefixSums::kMostSide];

  BlockPrefixSums(const RowPrefixSums& row_sums, const Block& block, int row, int col)
      : base(row_sums.base()) {
    for (int v = 0; v < block.rows; ++v)
      row_offset[v] = row_sums.offset(row + block.first_row + v, col + block.first_col);
  }
  HWY_INLINE VI row_offsets(int v) const {
    const VI lanes = hn::Mul(hn::Iota(di, 0), hn::Set(di, RowPrefixSums::kBytes));
    return hn::Add(lanes, hn::Set(di, row_offset[v]));
  }
};

/// Bytes from the entry of a column to the entry n columns on; `power` = 2^n.
HWY_INLINE VI entry_offset(VI power) {
  constexpr int kMantissaBits = 23, kBias = 127, kSize = std::countr_zero(unsigned{RowPrefixSums::kBytes});
  // n is the exponent of the power as a float, of which 2^31 has the sign set.
  const VI exponent = hn::ShiftRight<kMantissaBits - kSize>(hn::BitCast(di, hn::ConvertTo(df, power)));
  return hn::Sub(hn::And(exponent, hn::Set(di, 0xff << kSize)), hn::Set(di, kBias << kSize));
}

using RunEnds = std::int32_t[kPlanes][RowPrefixSums::kMostSide][kLanes];

/// Removes the run of ones at the beginning of each row from `sides` and writes the offset of the entry after
/// it to `ends`. Where the points in front are at the end of the rows, it exchanges the two sides first.
HWY_INLINE void take_first_runs(const BlockPrefixSums& entries, const Block& block,
                                const BlockCentres& centres, Sides& sides, RunEnds& ends) {
  const VI one = hn::Set(di, 1);
  const VI all = hn::Set(di, static_cast<std::int32_t>((1u << block.cols) - 1));
  for (int i = 0; i < kPlanes; ++i) {
    const MF at_end = hn::Lt(hn::Load(df, centres.per_col[i]), zero());
    const VI flip = hn::IfThenElseZero(hn::RebindMask(di, at_end), all);
    for (int v = 0; v < block.rows; ++v) {
      const VI x = hn::And(hn::Xor(hn::Load(di, sides.rows[i][v]), flip), all), next = hn::Add(x, one);
      hn::Store(hn::And(x, next), di, sides.rows[i][v]);
      hn::Store(hn::Add(entry_offset(hn::AndNot(x, next)), entries.row_offsets(v)), di, ends[i][v]);
    }
  }
}

using BlockSums = std::int32_t[kLanes][kPlanes][RowPrefixSums::kNumbers];

/// Sets the sums to those of the runs at the beginning of rows.
HWY_INLINE void add_first_runs(const BlockPrefixSums& entries, const Block& block,
                               const BlockCentres& centres, const RunEnds& ends, BlockSums& sums) {
  for (int n = 0; n < centres.count; ++n) {
    const int lane = centres.lanes[n];
    EntrySum before;
    for (int v = 0; v < block.rows; ++v)
      before.subtract(entry_at(entries.base, entries.row_offset[v] + lane * RowPrefixSums::kBytes));
    EntrySum sum[kPlanes] = {before, before, before};
    for (int v = 0; v < block.rows; ++v)
      for (int i = 0; i < kPlanes; ++i) sum[i].add(entry_at(entries.base, ends[i][v][lane]));
    for (int i = 0; i < kPlanes; ++i) sum[i].store(sums[lane][i]);
  }
}

/// Runs of points, each with the sum (of BlockSums) that it belongs to. They are listed first and added
/// later, because the processor cannot predict their number in a row.
class RunList {
 public:
  HWY_INLINE bool full() const { return size_ > kMost; }
  HWY_INLINE void push(MF some, VI begins, VI ends, VI sums) {
    const LanePacker pack(some);
    hn::StoreU(pack(begins), di, begins_ + size_);
    hn::StoreU(pack(ends), di, ends_ + size_);
    hn::StoreU(pack(sums), di, sums_ + size_);
    size_ += pack.size();
  }
  /// Adds the runs to their sums and empties the list.
  HWY_INLINE void add_to(BlockSums& sums, const char* base) {
    for (std::size_t i = 0; i < size_; ++i) {
      std::int32_t* const out = sums[0][0] + sums_[i];
      EntrySum sum;
      sum.add(out);
      sum.add(entry_at(base, ends_[i]));
      sum.subtract(entry_at(base, begins_[i]));
      sum.store(out);
    }
    size_ = 0;
  }

 private:
  static constexpr std::size_t kMost = 256;
  std::size_t size_ = 0;
  std::int32_t begins_[kMost + 2 * kLanes], ends_[kMost + 2 * kLanes], sums_[kMost + 2 * kLanes];
};

/// Adds the runs that take_first_runs() has left: few for the planes across the surface, many for the plane
/// along it, where noise decides the side.
HWY_INLINE void add_other_runs(const BlockPrefixSums& entries, const Block& block, const Sides& sides,
                               BlockSums& sums) {
  RunList runs;
  const VI lanes = hn::Mul(hn::Iota(di, 0), hn::Set(di, kPlanes * RowPrefixSums::kNumbers));
  for (int i = 0; i < kPlanes; ++i) {
    const VI sum = hn::Add(lanes, hn::Set(di, i * RowPrefixSums::kNumbers));
    for (int v = 0; v < block.rows; ++v) {
      VI rest = hn::Load(di, sides.rows[i][v]);
      auto some = hn::Ne(rest, hn::Zero(di));
      if (hn::AllFalse(di, some)) continue;
      const VI row = entries.row_offsets(v);
      do {
        const VI begin = hn::And(rest, hn::Neg(rest));
        const VI carried = hn::Add(rest, begin);  // the first run becomes 0, the bit after it 1
        runs.push(hn::RebindMask(df, some), hn::Add(entry_offset(begin), row),
                  hn::Add(entry_offset(hn::AndNot(rest, carried)), row), sum);
        if (runs.full()) runs.add_to(sums, entries.base);
        rest = hn::And(rest, carried);
        some = hn::Ne(rest, hn::Zero(di));
      } while (!hn::AllFalse(di, some));
    }
  }
  runs.add_to(sums, entries.base);
}

/// Adds the sums of a block around the centres at (row, col..) to `sums`, in the units of RowPrefixSums; z0
/// is the centres' depth.
HWY_INLINE void add_block(const BlockSums& block_sums, const Block& block, int row, int col, VI z0,
                          HalfSums* sums) {
  const VI index = hn::Mul(hn::Iota(di, 0), hn::Set(di, kPlanes * RowPrefixSums::kNumbers));
  // Sums of z times rows and columns fit 32 bits only if taken about the middle of the block.
  const int middle_row = block.first_row + block.rows / 2, middle_col = block.first_col + block.cols / 2;
  const VI rows = hn::Set(di, row + middle_row), cols = hn::Iota(di, col + middle_col);
  const auto real = [](VI v) HWY_ATTR { return hn::ConvertTo(df, v); };
  for (int i = 0; i < kPlanes; ++i) {
    const auto get = [&](RowPrefixSums::Number number)
                         HWY_ATTR { return hn::GatherIndex(di, block_sums[0][i] + number, index); };
    const VI count = get(RowPrefixSums::kCount), z = get(RowPrefixSums::kZ);
    const VF z_rows = real(hn::Sub(get(RowPrefixSums::kZRows), hn::Mul(z, rows)));
    const VF z_cols = real(hn::Sub(get(RowPrefixSums::kZCols), hn::Mul(z, cols)));
    HalfSums& sum = sums[i];
    sum.count = hn::Add(sum.count, real(count));
    sum.z = hn::Add(sum.z, real(hn::Sub(z, hn::Mul(count, z0))));
    sum.z_rows = hn::Add(sum.z_rows, hn::MulAdd(real(z), set(static_cast<float>(middle_row)), z_rows));
    sum.z_cols = hn::Add(sum.z_cols, hn::MulAdd(real(z), set(static_cast<float>(middle_col)), z_cols));
    sum.normal = sum.normal + Vec3{real(get(RowPrefixSums::kNormalX)), real(get(RowPrefixSums::kNormalY)),
                                   real(get(RowPrefixSums::kNormalZ))};
  }
}

/// The sums of sum_in_front(), or those of the other half of the window, with the same score.
///
/// A plane through the centre splits most rows of a window once, into a run of points in front and one
/// behind. So the sums over a half need a few differences of prefix sums a row, however long the row is; only
/// the comparison that decides a point's side is done for every point. The sums are exact.
HWY_NOINLINE void sum_runs_in_front(const LevelPlanes& level, const RowPrefixSums& row_sums, int row, int col,
                                    const Window& window, const Centres& centres, const Vec3* gamma,
                                    HalfSums* sums) {
  const std::ptrdiff_t at = level.at(row, col);
  const VI packed = hn::BitCast(di, load(level.plane(LevelPlanes::kPacked) + at));
  const VI z0 = hn::And(packed, hn::Set(di, level.packing.depth_mask()));
  const BlockCentres points(points_at(level, row, col),
                            SweepPlanes(gamma, centres, load(level.plane(LevelPlanes::kDepth) + at)));
  for (int i = 0; i < kPlanes; ++i) sums[i] = {zero(), zero(), zero(), zero(), {zero(), zero(), zero()}};
  alignas(64) BlockSums block_sums = {};
  alignas(64) RunEnds ends;
  for (int first_row = window.first_row; first_row <= window.last_row; first_row += RowPrefixSums::kMostSide)
    for (int first_col = -window.reach; first_col <= window.reach; first_col += RowPrefixSums::kMostSide) {
      const Block block{first_row, std::min(RowPrefixSums::kMostSide, window.last_row + 1 - first_row),
                        first_col, std::min(RowPrefixSums::kMostSide, window.reach + 1 - first_col)};
      const BlockPrefixSums block_entries(row_sums, block, row, col);
      Sides sides;
      for (int n = 0; n < points.count; ++n) find_sides(level, at, block, points, points.lanes[n], sides);
      take_first_runs(block_entries, block, points, sides, ends);
      add_first_runs(block_entries, block, points, ends, block_sums);
      add_other_runs(block_entries, block, sides, block_sums);
      add_block(block_sums, block, row, col, z0, sums);
    }
  const VF mm = set(1 / level.packing.units_per_mm);
  const VF normal_unit = set(1.0f / normal_units(window.reach));
  for (int i = 0; i < kPlanes; ++i) {
    sums[i].z = hn::Mul(sums[i].z, mm);
    sums[i].z_rows = hn::Mul(sums[i].z_rows, mm);
    sums[i].z_cols = hn::Mul(sums[i].z_cols, mm);
    sums[i].normal = sums[i].normal * normal_unit;
    // The centre counts as behind each plane, so a half that was exchanged for the one in front contains it.
    const MF exchanged = hn::Lt(hn::Load(df, points.per_col[i]), zero());
    const auto centre = [&](LevelPlanes::Plane plane)
                            HWY_ATTR { return hn::IfThenElseZero(exchanged, load(level.plane(plane) + at)); };
    sums[i].count = hn::Sub(sums[i].count, hn::IfThenElseZero(exchanged, set(1.0f)));
    sums[i].normal = sums[i].normal - Vec3{centre(LevelPlanes::kNormalX), centre(LevelPlanes::kNormalY),
                                           centre(LevelPlanes::kNormalZ)};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace saccade
HWY_AFTER_NAMESPACE();

#endif
