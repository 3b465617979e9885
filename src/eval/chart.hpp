#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "eval/drawing.hpp"

namespace saccade {

/// What the figures have in common: colours, markers and legends. Colour-blind readers can distinguish the
/// colours (Okabe and Ito) and markers.

inline constexpr Colour kInk{40, 40, 40}, kGrid{224, 224, 224}, kGray{110, 110, 110};

/// The margins of a chart for its title and the numbers of its axes, px.
inline constexpr double kChartLeft = 62, kChartTop = 44;

/// How one series of a chart is drawn.
struct SeriesStyle {
  std::string name;
  Colour colour;
  std::array<double, 2> dash = {0, 0};
  int marker = -1;  ///< -1 = none
};

/// The style of the number-th series, from 0.
SeriesStyle style_of(const std::string& name, std::size_t number);

/// The corners of a marker around `at`: a disc, a square, a triangle or a diamond.
std::vector<cv::Point2d> marker_corners(int marker, cv::Point2d at);

/// A line and a name for each series, from `corner` down.
inline constexpr double kLegendLine = 19;
void draw_legend(Drawing& drawing, cv::Point2d corner, std::span<const SeriesStyle> series);

}  // namespace saccade
