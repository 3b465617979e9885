#pragma once

#include <array>
#include <cstddef>

#include <hwy/aligned_allocator.h>
#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"

namespace saccade {

/// How a pixel's depth and the number 1 share 32 bits, so that one addition both counts and sums: the depth,
/// as an integer number of units, in the lower `depth_bits` bits, and the 1 above them. The sum over
/// `columns` columns of a window keeps both exact.
struct DepthPacking {
  static constexpr int kMostUnits = 1 << 19;  ///< upper limit of a depth: 65535 mm in eighths

  float units_per_mm = 8;
  int depth_bits = 0;
  int columns = 0;

  int one() const { return 1 << depth_bits; }               ///< the 1 that a pixel adds to the count
  int depth_mask() const { return (1 << depth_bits) - 1; }  ///< the bits of the depth

  /// For depths up to `largest_mm` <= 65535 and windows of `rows` rows and columns. If all depths are
  /// multiples of 1/8 mm, nothing is rounded; that holds on every level but the first, and there too for
  /// usual sensors. Otherwise depths are rounded, in these sums only, to units of 1/256 mm or as coarse as
  /// the range needs.
  /// Differs from section 2: beyond 33 m the largest windows sum in units coarser than eighths.
  static DepthPacking for_depths(float largest_mm, bool multiples_of_eighths, int rows);
};

/// One pyramid level as a structure of arrays. Margins of invalid pixels surround each image, so that the
/// stages need no border test in the columns.
///
/// Every plane has height + 2 * kMarginRows rows of `stride` floats, of which column 0 is aligned to a
/// vector; `at(row, col)` is the same offset in each. Rows from -kMarginRows and columns from -margin_cols()
/// on may be addressed.
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
    kScore,  ///< the symmetry map of this level; add_upsampled_rows() adds the coarser levels to it
    kPlanes
  };

  static constexpr int kMarginRows = 2;     ///< reach of the 5 x 5 windows of the normals
  static constexpr int kVectorFloats = 16;  ///< the widest vector

  /// For an image of `size` and windows that reach `reach` columns; all pixels invalid.
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

  void scale_scores(float weight);
  /// Copy without margins, reusing memory: h x w.
  void copy_scores(cv::Mat1f& map) const;
  void copy_normals(cv::Mat3f& normals) const;

  Intrinsics camera;     ///< of this level
  DepthPacking packing;  ///< of kPacked

 private:
  int width_, height_, margin_cols_;
  std::ptrdiff_t stride_;
  hwy::AlignedFreeUniquePtr<float[]> memory_;
  std::array<float*, kPlanes> planes_{};  // at row 0, column 0
};

}  // namespace saccade
