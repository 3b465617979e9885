#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>

#include "saliency/simd/aligned_memory.hpp"
#include "saliency/simd/row_prefix_sums.hpp"

namespace saccade {

/// A row of numbers with margins on both sides that may be read; they hold 0 unless a user writes there.
template <typename T>
class PaddedRow {
 public:
  static constexpr int kLeft = 128, kRight = 256;

  PaddedRow() = default;
  explicit PaddedRow(int width) {
    const std::size_t count = static_cast<std::size_t>(kLeft + width + kRight);
    memory_ = allocate_aligned<T>(count);
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

/// For each column, sums over the rows of a window. Normals, their products and depths are rounded to
/// integers of a small unit, so that their sums are exact in any order. DepthPacking leaves room for
/// kDepthRows too.
struct VerticalSums {
  enum Sum { kX, kY, kZ, kXX, kYY, kZZ, kXY, kXZ, kYZ, kNormals, kPacked = kNormals, kDepthRows, kSums };
  /// kPacked as in LevelPlanes; kDepthRows: depth times the number of rows below the centre.
  std::array<PaddedRow<std::int32_t>, kSums> sums;

  explicit VerticalSums(int width) : sums(padded_rows<std::int32_t, kSums>(width)) {}
};

/// Prefix sums of VerticalSums along the row, each including its own column: the sum over a window is the
/// difference of two. It is right in 32 bits if the window's sum fits, even where the prefix sums overflow.
struct WindowPrefixSums {
  enum Integer { kDepth = VerticalSums::kNormals, kIntegers };  ///< after the normals of VerticalSums
  enum Double { kDepthRows, kDepthCols, kDoubles };
  std::array<PaddedRow<std::int32_t>, kIntegers> integers;
  std::array<PaddedRow<double>, kDoubles> doubles;

  explicit WindowPrefixSums(int width)
      : integers(padded_rows<std::int32_t, kIntegers>(width)),
        doubles(padded_rows<double, kDoubles>(width)) {}
};

/// Per pixel of a row: what depends on the window as a whole, before its points are split by planes.
struct RowStatistics {
  enum Value {
    kCovXX,
    kCovYY,
    kCovZZ,
    kCovXY,
    kCovXZ,
    kCovYZ,  ///< covariance of the window's normals, times the square of their number
    kAxis0,
    kAxis1 = kAxis0 + 3,
    kAxis2 = kAxis1 + 3,  ///< x, y, z of the covariance's eigenvectors
    kCount = kAxis2 + 3,  ///< from here on sums over the window without its centre, as in HalfSums
    kZ,
    kZRows,
    kZCols,
    kNormalX,
    kNormalY,
    kNormalZ,
    kValues
  };
  std::array<PaddedRow<float>, kValues> values;
  std::vector<int> groups;  ///< first columns of the vectors that cover the row's points without overlap

  explicit RowStatistics(int width) : values(padded_rows<float, kValues>(width)) {
    groups.reserve(static_cast<std::size_t>(width));
  }
  float* row(int value) { return values[static_cast<std::size_t>(value)].data(); }
};

/// Memory of one worker; sized for the widest row and the largest window, and kept between frames.
struct RowScratch {
  static constexpr int kPreparedRows = 4;  ///< rows whose statistics are computed before any window is split

  explicit RowScratch(int width)
      : vertical_sums(width),
        window_sums(width),
        halving(padded_rows<double, 4>(width)),
        upsampling(padded_rows<float, 2>(width)) {
    for (int r = 0; r < kPreparedRows; ++r) statistics.emplace_back(width);
  }

  RowPrefixSums row_sums;  ///< of the rows within reach; empty unless the window reaches runs_from_reach
  VerticalSums vertical_sums;
  WindowPrefixSums window_sums;
  std::vector<RowStatistics> statistics;       ///< of each prepared row
  std::array<PaddedRow<double>, 4> halving;    ///< pyramid: depths and weights of even and of odd columns
  std::array<PaddedRow<float>, 2> upsampling;  ///< master map
};

}  // namespace saccade
