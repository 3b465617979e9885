#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <hwy/aligned_allocator.h>
#include <opencv2/core.hpp>

namespace saccade {

/// Prefix sums over the operator's points along image rows, for as many rows as windows reach. The entry at
/// column c holds the sums over the columns before c of its row, so that the sum over any run of columns is
/// the difference of two entries.
///
/// All are 32-bit integers that may overflow: differences are exact as long as the sums over a block of
/// kMostSide rows and columns fit, those of kZRows and kZCols taken about its middle.
class RowPrefixSums {
 public:
  enum Number { kCount, kZ, kZRows, kZCols, kNormalX, kNormalY, kNormalZ, kNumbers = 8 };
  static constexpr int kBytes = kNumbers * sizeof(std::int32_t);  ///< of an entry
  static constexpr int kMostSide = 31;

  RowPrefixSums() = default;
  /// For levels up to `size`, windows that reach `reach` rows and columns, and `rows` rows at a time.
  RowPrefixSums(cv::Size size, int reach, int rows);

  std::int32_t* at(int row, int col) {
    return reinterpret_cast<std::int32_t*>(memory_.get() + offset(row, col));
  }
  const char* base() const { return memory_.get(); }
  /// Bytes from base() to the entry at (row, col); col from -reach to the width in whole vectors + reach.
  std::int32_t offset(int row, int col) const {
    return row_offset_[static_cast<std::size_t>(row)] + col * kBytes;
  }

 private:
  std::vector<std::int32_t> row_offset_;
  hwy::AlignedFreeUniquePtr<char[]> memory_;
};

}  // namespace saccade
