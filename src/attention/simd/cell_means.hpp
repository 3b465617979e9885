#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace saccade {

/// Pixels along a side of a cell.
inline constexpr int kCellPx = 4;

/// The rows of an image that make one row of cells.
using PixelRows = std::array<const float*, kCellPx>;

/// Depth of a cell whose pixels are not of one surface; mean_depths() leaves it to its caller.
inline constexpr float kMixedDepth = -1;

/// Writes the mean depth of each of the first `cells` cells, all of them whole, to depth[0..cells): of one
/// whose pixels all have depth and lie within `same_surface` of the nearest; 0 if no pixel has depth (0 = no
/// reading), else kMixedDepth. mm.
void mean_depths(const PixelRows& rows, float same_surface, float* depth, std::size_t cells);

/// Writes the mean of each of the first `cells` cells, all of them whole, to mean[0..cells).
void mean_values(const PixelRows& rows, float* mean, std::size_t cells);

/// out[i] = sum over k of weights[k] * rows[k][i] for i in 0..count, added in the order of k. There is at
/// least one row; `out` is none of them.
void add_weighted(std::span<const float* const> rows, std::span<const float> weights, float* out,
                  std::size_t count);

}  // namespace saccade
