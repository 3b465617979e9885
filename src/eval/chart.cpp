#include "eval/chart.hpp"

#include <cmath>
#include <numbers>

namespace saccade {
namespace {

// Okabe and Ito's palette without its yellow, which is too light for lines.
constexpr std::array<Colour, 7> kPalette = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {0, 0, 0}}};
constexpr int kMarkers = 4;

}  // namespace

SeriesStyle style_of(const std::string& name, std::size_t number) {
  SeriesStyle style{name, kPalette[number % kPalette.size()], {0, 0}, static_cast<int>(number)};
  if (number >= kPalette.size()) style.dash = {9, 3};
  return style;
}

std::vector<cv::Point2d> marker_corners(int marker, cv::Point2d at) {
  constexpr double kRadius = 3.6;
  constexpr std::array<int, kMarkers> kCorners = {16, 4, 3, 4};
  constexpr std::array<double, kMarkers> kTurn = {0, 0.25, -0.5, 0};
  const auto kind = static_cast<std::size_t>(marker % kMarkers);
  std::vector<cv::Point2d> corners;
  for (int i = 0; i < kCorners[kind]; ++i) {
    const double angle = (2.0 * i / kCorners[kind] + kTurn[kind]) * std::numbers::pi;
    corners.push_back(at + kRadius * cv::Point2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

void draw_legend(Drawing& drawing, cv::Point2d corner, std::span<const SeriesStyle> series) {
  cv::Point2d left = corner;
  for (const SeriesStyle& s : series) {
    const cv::Point2d middle = left + cv::Point2d(15, -4);
    drawing.shapes.emplace_back(
        Line{{left + cv::Point2d(0, -4), left + cv::Point2d(30, -4)}, s.colour, 2, s.dash});
    if (s.marker >= 0) drawing.shapes.emplace_back(Area{marker_corners(s.marker, middle), s.colour});
    drawing.shapes.emplace_back(Text{left + cv::Point2d(38, 0), s.name, 12, Anchor::start, kInk});
    left.y += kLegendLine;
  }
}

}  // namespace saccade
