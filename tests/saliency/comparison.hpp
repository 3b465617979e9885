#pragma once

#include <string>

#include <opencv2/core.hpp>

#include "saliency/reference.hpp"
#include "saliency/symmetry3d.hpp"

namespace saccade::test {

/// Compares the production form with the reference on one image.
struct Comparison {
  reference::Result expected;
  std::vector<reference::Level> levels;  ///< points and normals, level first_level + i
  Symmetry3dParams params;
  cv::Mat1f depth_mm;
  Intrinsics camera;

  Comparison(const cv::Mat1f& depth, const Intrinsics& intrinsics, const Symmetry3dParams& p);

  /// Runs the production form and checks, with EXPECT: sizes; all numbers finite and not negative; the master
  /// map within 1 % of its maximum at 99.5 % of the pixels, and within `noticed` at all but a share `excused`
  /// of them; and that each pixel of a level that differs by more than `noticed` is a near-tie.
  void check(const std::string& simd, double excused = 0.001, double noticed = 1e-5) const;

 private:
  void check_level(std::size_t i, const cv::Mat1f& actual, double noticed) const;
};

/// The verdict on a value of the production form.
enum class Answer {
  right,
  near_tie,   ///< right if some points nearly on a plane, or a gate nearly shut, are decided the other way
  undefined,  ///< two eigenvalues are so close that the axes, and the sides of many points, are arbitrary
  wrong
};

/// Judges `actual` at a pixel by trying every outcome of the decisions that depend on the last bits.
Answer judge(const reference::Level& level, int row, int col, const Symmetry3dParams& params, double actual,
             double tolerance);

}  // namespace saccade::test
