#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "attention/surface_grid.hpp"
#include "core/intrinsics.hpp"

namespace saccade {

inline constexpr int kCell = SurfaceGrid::kCellPx;

/// A box standing on the table, or a ball lying on it. World: x right, y away, z up, mm; the table is z = 0.
struct Thing {
  cv::Point3d low, high;  ///< box: two corners
  double radius = 0;      ///< above 0: a ball in the middle of the box
};

/// What an exact depth camera above the table sees.
struct TableScene {
  Intrinsics camera{525, 525, 319.5, 239.5, IntrinsicsOrigin::guess};
  cv::Mat1f depth_mm;   ///< H x W, 0 = nothing there
  cv::Mat1i labels;     ///< 0 = table, i = the i-th thing, from 1
  cv::Mat3f points_mm;  ///< camera frame
};

/// The camera stands 600 mm above the table and looks down by 40 degrees; the table is 1200 mm wide.
TableScene look_at_table(const std::vector<Thing>& things, cv::Size size = {640, 480});

Thing box(double x, double y, double width, double depth, double height);
Thing ball(double x, double y, double radius);

/// A map with a smooth hill of the given height over each pixel listed.
cv::Mat1f hills(cv::Size size, const std::vector<std::pair<cv::Point, float>>& list);

/// The middle pixel of a label's pixels: the one nearest to their mean.
cv::Point middle_of(const cv::Mat1i& labels, int label);

}  // namespace saccade
