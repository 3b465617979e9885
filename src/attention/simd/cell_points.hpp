#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/simd/cell_means.hpp"

namespace saccade {

/// One value for each pixel of a cell, row by row.
using CellBlock = std::array<float, static_cast<std::size_t>(kCellPx) * kCellPx>;

/// A depth image and its cells.
struct CellImage {
  const cv::Mat1f& depth_mm;            ///< H x W, 0 = no reading
  const float* cell_depth;              ///< of each cell, row by row
  int cell_cols;                        ///< cells in a row
  const std::vector<CellBlock>& ray_x;  ///< x/z of the pixels, by column of cells
  const std::vector<CellBlock>& ray_y;  ///< y/z of the pixels, by row of cells
};

/// Points (x, y, z) in mm, camera frame: how many, their sum and the box around them.
struct PointSums {
  static constexpr float kFar = std::numeric_limits<float>::max();

  int count = 0;
  std::array<double, 3> sum{};
  std::array<float, 3> low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
};

/// Adds up the points of the pixels of `cells` (indices) that have depth and lie within `same_surface` of
/// their cell's depth, and writes `rank` to `masks` (H x W) there.
PointSums paint_points(const CellImage& image, std::span<const int> cells, float same_surface,
                       std::uint16_t rank, cv::Mat1w& masks);

}  // namespace saccade
