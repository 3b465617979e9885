#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <opencv2/core.hpp>

#include "attention/surface_grid.hpp"

namespace saccade {

/// The depth of the pixels of one cell, for vector instructions: rows of kCellPx floats, in mm, 0 = no
/// reading. A whole cell is read in place; of one that the border cuts, the pixels outside have no reading.
/// Valid as long as the image and this object live where they are.
class CellPixels {
 public:
  /// row, col: of the cell, which holds at least one pixel of the image.
  CellPixels(const cv::Mat1f& depth_mm, int row, int col) {
    constexpr int kCell = SurfaceGrid::kCellPx;
    const int top = row * kCell, left = col * kCell;
    rows_ = std::min(kCell, depth_mm.rows - top);
    cols_ = std::min(kCell, depth_mm.cols - left);
    for (int v = 0; v < kCell; ++v) {
      const auto k = static_cast<std::size_t>(v);
      if (v < rows_ && cols_ == kCell) {
        pixels_[k] = depth_mm[top + v] + left;
        continue;
      }
      copy_[k].fill(0);
      if (v < rows_) std::copy_n(depth_mm[top + v] + left, cols_, copy_[k].begin());
      pixels_[k] = copy_[k].data();
    }
  }
  CellPixels(const CellPixels&) = delete;
  CellPixels& operator=(const CellPixels&) = delete;

  const float* row(int v) const { return pixels_[static_cast<std::size_t>(v)]; }
  int rows() const { return rows_; }  ///< inside of the image
  int cols() const { return cols_; }

 private:
  std::array<const float*, SurfaceGrid::kCellPx> pixels_;
  std::array<std::array<float, SurfaceGrid::kCellPx>, SurfaceGrid::kCellPx> copy_;
  int rows_, cols_;
};

}  // namespace saccade
