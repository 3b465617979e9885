#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <opencv2/core.hpp>

#include "attention/simd/cell_means.hpp"

namespace saccade {

/// The pixels of one cell of an image, for vector instructions: rows of kCellPx floats. A whole cell is read
/// in place; of one that the border cuts, the pixels outside are 0. Valid as long as the image and this
/// object live where they are.
class CellPixels {
 public:
  /// row, col: of the cell, which holds at least one pixel of the image.
  CellPixels(const cv::Mat1f& image, int row, int col) {
    const int top = row * kCellPx, left = col * kCellPx;
    rows_ = std::min(kCellPx, image.rows - top);
    cols_ = std::min(kCellPx, image.cols - left);
    for (int v = 0; v < kCellPx; ++v) {
      const auto k = static_cast<std::size_t>(v);
      if (v < rows_ && cols_ == kCellPx) {
        pixels_[k] = image[top + v] + left;
        continue;
      }
      copy_[k].fill(0);
      if (v < rows_) std::copy_n(image[top + v] + left, cols_, copy_[k].begin());
      pixels_[k] = copy_[k].data();
    }
  }
  CellPixels(const CellPixels&) = delete;
  CellPixels& operator=(const CellPixels&) = delete;

  const float* row(int v) const { return pixels_[static_cast<std::size_t>(v)]; }
  int rows() const { return rows_; }  ///< inside of the image
  int cols() const { return cols_; }

 private:
  PixelRows pixels_;
  std::array<std::array<float, kCellPx>, kCellPx> copy_;
  int rows_, cols_;
};

}  // namespace saccade
