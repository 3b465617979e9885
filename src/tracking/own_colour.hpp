#pragma once

#include <optional>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "attention/surface_grid.hpp"

namespace saccade {

/// The chromaticity of a cell, (blue, red) / (blue + green + red), from the four pixels in its middle; both
/// are negative if the cell is too dark to have one. colour: H x W of the grid's frame, BGR.
cv::Vec2f chromaticity(const SurfaceGrid& grid, const cv::Mat3b& colour, int cell);

/// Euclidean distance of two chromaticities, in blue, green and red.
float distance(const cv::Vec2f& a, const cv::Vec2f& b);

/// The colour that most of a surface has, whatever else stands on it or before it: the mean around the most
/// frequent chromaticity. Keeps its memory between calls. Thread safety: one call at a time per object.
class OwnColour {
 public:
  static constexpr float kReach = 0.06F;  ///< distance from the own colour, of the cells that have it
  static constexpr int kDarkest = 40;     ///< b + g + r of a pixel; below it the colour is noise

  /// Of the cells with these chromaticities; none if less than `share` of them have it.
  std::optional<cv::Vec2f> find(std::span<const cv::Vec2f> chromaticities, double share);

 private:
  static constexpr int kBins = 32;  // of each of the two parts

  std::vector<int> bins_;
};

}  // namespace saccade
