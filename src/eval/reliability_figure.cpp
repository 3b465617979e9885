#include "eval/reliability_figure.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "eval/chart.hpp"

namespace saccade {
namespace {

constexpr double kSide = 320, kBottom = 56, kReliabilityLegendWidth = 330;

cv::Point2d place(double confidence, double on_object) {
  return {kChartLeft + confidence * kSide, kChartTop + (1 - on_object) * kSide};
}

void draw_axes(Drawing& drawing) {
  for (int i = 0; i <= 5; ++i) {
    const double value = i / 5.0;
    const Colour colour = i == 0 ? kInk : kGrid;
    drawing.shapes.emplace_back(Line{{place(0, value), place(1, value)}, colour, 1});
    drawing.shapes.emplace_back(Line{{place(value, 0), place(value, 1)}, colour, 1});
    const std::string number = fmt::format("{:.1f}", value);
    drawing.shapes.emplace_back(Text{place(0, value) + cv::Point2d(-7, 4), number, 12, Anchor::end, kInk});
    drawing.shapes.emplace_back(Text{place(value, 0) + cv::Point2d(0, 19), number, 12, Anchor::middle, kInk});
  }
  drawing.shapes.emplace_back(Line{{place(0, 0), place(1, 1)}, kGray, 1, {7, 4}});
  drawing.shapes.emplace_back(
      Text{place(0.5, 0) + cv::Point2d(0, 40), "confidence", 13, Anchor::middle, kInk});
  drawing.shapes.emplace_back(
      Text{place(0, 0.5) + cv::Point2d(-40, 0), "share on objects", 13, Anchor::middle, kInk, true});
  drawing.shapes.emplace_back(
      Text{{kChartLeft, 28}, "Reliability of the confidence", 15, Anchor::start, kInk});
}

void draw_series(Drawing& drawing, const Reliability& reliability, const SeriesStyle& style) {
  std::vector<cv::Point2d> points;
  for (const Reliability::Bin& bin : reliability.bins)
    if (bin.points >= kFewestInBin) points.push_back(place(bin.confidence, bin.on_object));
  drawing.shapes.emplace_back(Line{points, style.colour, 2, style.dash});
  for (const cv::Point2d& point : points)
    drawing.shapes.emplace_back(Area{marker_corners(style.marker, point), style.colour});
}

}  // namespace

std::optional<Drawing> draw_reliability(const EvalPlan& plan, const Statistics& statistics) {
  Drawing drawing;
  draw_axes(drawing);
  std::vector<SeriesStyle> legend;
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (const auto& reliability = statistics.reliability[i]) {
      legend.push_back(style_of(describe(conditions[i]), legend.size()));
      draw_series(drawing, *reliability, legend.back());
    }
  if (legend.empty()) return std::nullopt;
  draw_legend(drawing, {kChartLeft + kSide + 24, kChartTop + 12}, legend);
  drawing.width = kChartLeft + kSide + 24 + kReliabilityLegendWidth;
  drawing.height =
      kChartTop + std::max(kSide + kBottom, 12 + kLegendLine * static_cast<double>(legend.size()));
  return drawing;
}

}  // namespace saccade
