#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "saliency/point_records.hpp"

namespace saccade {

/// A row of numbers with margins on both sides that may be read (and hold 0 unless a user writes there).
template <typename T>
class PaddedRow {
 public:
  static constexpr int kLeft = 128, kRight = 256;

  PaddedRow() = default;
  explicit PaddedRow(int width) {
    const std::size_t count = static_cast<std::size_t>(kLeft + width + kRight);
    memory_ = hwy::AllocateAligned<T>(count);
    for (std::size_t i = 0; i < count; ++i) memory_[i] = T{};
  }
  T* data() { return memory_.get() + kLeft; }  ///< at column 0, aligned to a vector

 private:
  hwy::AlignedFreeUniquePtr<T[]> memory_;
};

template <typename T, std::size_t kRows>
std::array<PaddedRow<T>, kRows> padded_rows(int width) {
  std::array<PaddedRow<T>, kRows> rows;
  for (auto& row : rows) row = PaddedRow<T>(width);
  return rows;
}

/// Sums over the rows of a window, for each column. Normals, their products and depths are whole numbers of a
/// small unit, so that their sums are exact in any order. DepthPacking leaves room for kDepthRows too.
struct ColumnSums {
  enum Sum { kX, kY, kZ, kXX, kYY, kZZ, kXY, kXZ, kYZ, kNormals, kPacked = kNormals, kDepthRows, kSums };
  /// kPacked as in LevelPlanes; kDepthRows of depth times the rows from the centre.
  std::array<PaddedRow<std::int32_t>, kSums> sums;

  explicit ColumnSums(int width) : sums(padded_rows<std::int32_t, kSums>(width)) {}
};

/// Totals of ColumnSums from the first column to each. The difference of two is the sum of what lies between
/// them, and right in 32 bits where that has room in them, whatever the totals.
struct RunningTotals {
  enum Whole { kDepth = ColumnSums::kNormals, kWholes };  ///< after the normals of ColumnSums
  enum Double { kDepthRows, kDepthCols, kDoubles };
  std::array<PaddedRow<std::int32_t>, kWholes> whole;
  std::array<PaddedRow<double>, kDoubles> depth;

  explicit RunningTotals(int width)
      : whole(padded_rows<std::int32_t, kWholes>(width)), depth(padded_rows<double, kDoubles>(width)) {}
};

/// What the operator needs to know at each pixel of a row before it looks at single points.
struct RowStatistics {
  enum Value {
    kCovXX,
    kCovYY,
    kCovZZ,
    kCovXY,
    kCovXZ,
    kCovYZ,  ///< of the window's normals
    kAxis0,
    kAxis1 = kAxis0 + 3,
    kAxis2 = kAxis1 + 3,  ///< x, y, z of its eigenvectors
    kCount = kAxis2 + 3,  ///< sums over the window without its centre, as HalfSums has them
    kZ,
    kZRows,
    kZCols,
    kNormalX,
    kNormalY,
    kNormalZ,
    kValues
  };
  std::array<PaddedRow<float>, kValues> values;
  std::vector<int> groups;  ///< first columns of the vectors that hold the row's points, none of them twice

  explicit RowStatistics(int width) : values(padded_rows<float, kValues>(width)) {
    groups.reserve(static_cast<std::size_t>(width));
  }
  float* row(int value) { return values[static_cast<std::size_t>(value)].data(); }
};

/// Memory of one worker; sized for the widest row and the largest window, and kept between frames.
struct RowScratch {
  static constexpr int kPreparedRows = 4;  ///< so many rows are prepared before their points are looked at

  explicit RowScratch(int width)
      : columns(width),
        totals(width),
        halving(padded_rows<double, 4>(width)),
        upsampling(padded_rows<float, 2>(width)) {
    for (int r = 0; r < kPreparedRows; ++r) statistics.emplace_back(width);
  }

  PointRecords records;                        ///< of the rows that windows reach, if these are large
  ColumnSums columns;                          ///< of the window's rows
  RunningTotals totals;                        ///< of the columns
  std::vector<RowStatistics> statistics;       ///< of each prepared row
  std::array<PaddedRow<double>, 4> halving;    ///< pyramid: depths and weights of even and of odd columns
  std::array<PaddedRow<float>, 2> upsampling;  ///< master map
};

}  // namespace saccade
