#pragma once

#include <array>
#include <cstddef>

#include <hwy/aligned_allocator.h>
#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// How a pixel's depth and the number one share 32 bits, so that one addition counts and sums: the depth, in
/// whole units, in the lower `depth_bits`, and a one above them. The sum of `columns` columns of a window
/// keeps both exact.
struct DepthPacking {
  static constexpr int kMostUnits = 1 << 19;  ///< no depth has more: 65535 mm in eighths

  float units_per_mm = 8;
  int depth_bits = 0;
  int columns = 0;

  int one() const { return 1 << depth_bits; }               ///< what a pixel adds besides its depth
  int depth_mask() const { return (1 << depth_bits) - 1; }  ///< the bits of the depth

  /// For depths up to `largest_mm`, itself at most 65535, and windows of `rows` rows and columns. If all are
  /// multiples of 1/8 mm (as every level but the first is, and that too with a usual sensor) nothing is
  /// rounded; else depths are rounded to units of down to 1/256 mm where they are summed, and nowhere else.
  /// Differs: beyond 33 m the largest windows have no room for eighths and sum in coarser units.
  static DepthPacking for_depths(float largest_mm, bool multiples_of_eighths, int rows);
};

/// One pyramid level as structure of arrays. Around each image there are margins, which hold invalid pixels,
/// so that the kernels need no test for the border in the columns.
///
/// Every plane has height + 2 * kMarginRows rows of `stride` floats; `at(row, col)` is the same place in each
/// of them. Rows -kMarginRows and columns -margin_cols() may be addressed. Column 0 is aligned to a vector.
class LevelPlanes {
 public:
  enum Plane {
    kDepth,          ///< z in mm, 0 = no reading
    kInverse,        ///< 1/z, 0 where there is no reading
    kUsableInverse,  ///< 1/z of the operator's points, NaN where a pixel has no depth or no normal
    kPacked,         ///< bits of an integer: count and z of the operator's points (DepthPacking), 0 = none
    kNormalX,        ///< unit normals, 0 = none
    kNormalY,
    kNormalZ,
    kScore,  ///< the symmetry map of this level, then the sum of it and of the coarser ones
    kPlanes
  };

  static constexpr int kMarginRows = 2;     ///< what the 5 x 5 windows of the normals reach
  static constexpr int kVectorFloats = 16;  ///< the widest vector

  /// Memory for an image of `size` seen by windows that reach `reach` columns; all pixels invalid.
  LevelPlanes(cv::Size size, int reach);

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  int margin_cols() const { return margin_cols_; }

  float* plane(Plane p) { return planes_[p]; }
  const float* plane(Plane p) const { return planes_[p]; }
  std::ptrdiff_t at(int row, int col) const { return row * stride_ + col; }
  float* row(Plane p, int r) { return planes_[p] + at(r, 0); }
  const float* row(Plane p, int r) const { return planes_[p] + at(r, 0); }

  /// Multiplies the map of the level, kScore.
  void scale_scores(float weight);

  Intrinsics camera;     ///< of this level
  DepthPacking packing;  ///< of kPacked

 private:
  int width_, height_, margin_cols_;
  std::ptrdiff_t stride_;
  hwy::AlignedFreeUniquePtr<float[]> memory_;
  std::array<float*, kPlanes> planes_{};  // at row 0, column 0
};

}  // namespace saccade
