#include "saliency/simd/row_prefix_sums.hpp"

#include "saliency/simd/aligned_memory.hpp"

namespace saccade {

RowPrefixSums::RowPrefixSums(cv::Size size, int reach, int rows) {
  constexpr int kLine = 64, kPage = 4096, kVector = 16;
  const int margin = (reach + 1) / 2 * 2 * kBytes;  // a multiple of a line
  // Successive rows are offset by 17 lines beyond a multiple of a page, so that the rows of a window do not
  // compete for the same lines of the first-level cache.
  const int pitch =
      (margin + (size.width + kVector + reach + 1) * kBytes + kPage - 1) / kPage * kPage + 17 * kLine;
  memory_ = allocate_aligned<char>(static_cast<std::size_t>(pitch) * static_cast<std::size_t>(rows));
  for (int r = 0; r < size.height; ++r) row_offset_.push_back(r % rows * pitch + margin);
}

}  // namespace saccade
