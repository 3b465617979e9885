#include "eval/figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace saccade {
namespace {

constexpr double kPanelWidth = 380, kPanelHeight = 280, kLeft = 62, kTop = 44, kBottom = 52, kGap = 24;
constexpr double kLegendWidth = 190, kLegendLine = 19;
constexpr std::size_t kPanelsInRow = 4, kMostShaded = 4;
constexpr Colour kInk{40, 40, 40}, kGrid{224, 224, 224}, kGray{110, 110, 110};

// Okabe and Ito's palette without its yellow, which is too light for lines.
constexpr std::array<Colour, 7> kPalette = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {0, 0, 0}}};
constexpr int kMarkers = 4;

struct Series {
  std::string name;
  const Curve* curve = nullptr;
  Colour colour;
  std::array<double, 2> dash = {0, 0};
  int marker = -1;  // -1 = none
  bool shaded = false;
};

struct Panel {
  std::string title;
  std::vector<Series> series;
};

// Panels side by side under one legend.
struct Row {
  std::vector<Panel> panels;
};

// Corners of a marker about the origin: a disc, a square, a triangle, a diamond.
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

// Draws into the rectangle of one panel's axes.
class Axes {
 public:
  Axes(Drawing& drawing, cv::Point2d origin, int points)
      : drawing_(drawing), origin_(origin), points_(points) {}

  void draw(const Panel& panel, bool with_label) {
    frame(panel.title, with_label);
    for (const Series& series : panel.series)
      if (series.shaded) shade(series);
    for (std::size_t i = panel.series.size(); i-- > 0;) curve(panel.series[i]);
  }

 private:
  cv::Point2d at(double n, double ratio) const {
    const double share = points_ > 1 ? (n - 1) / (points_ - 1) : 0.5;
    return origin_ + cv::Point2d(share * kPanelWidth, (1 - ratio) * kPanelHeight);
  }

  void line(cv::Point2d a, cv::Point2d b, Colour colour, double width) {
    drawing_.shapes.emplace_back(Line{{a, b}, colour, width});
  }

  void frame(const std::string& title, bool with_label) {
    for (int i = 0; i <= 5; ++i) {
      const double ratio = i / 5.0;
      const cv::Point2d left = origin_ + cv::Point2d(0, (1 - ratio) * kPanelHeight);
      line(left, left + cv::Point2d(kPanelWidth, 0), i == 0 ? kInk : kGrid, 1);
      drawing_.shapes.emplace_back(
          Text{left + cv::Point2d(-7, 4), fmt::format("{:.1f}", ratio), 12, Anchor::end, kInk});
    }
    const int step = points_ <= 10 ? 1 : points_ <= 50 ? 5 : 10 * ((points_ + 99) / 100);
    for (int n = 1; n <= points_; n = n == 1 && step > 1 ? step : n + step) {
      const cv::Point2d foot = at(n, 0);
      line(foot, foot + cv::Point2d(0, 5), kInk, 1);
      drawing_.shapes.emplace_back(
          Text{foot + cv::Point2d(0, 19), std::to_string(n), 12, Anchor::middle, kInk});
    }
    line(origin_, origin_ + cv::Point2d(0, kPanelHeight), kInk, 1);
    const cv::Point2d middle = origin_ + cv::Point2d(kPanelWidth / 2, 0);
    drawing_.shapes.emplace_back(Text{middle + cv::Point2d(0, -12), title, 14, Anchor::middle, kInk});
    drawing_.shapes.emplace_back(Text{middle + cv::Point2d(0, kPanelHeight + 40),
                                      "number of attention points n", 13, Anchor::middle, kInk});
    if (with_label)
      drawing_.shapes.emplace_back(Text{origin_ + cv::Point2d(-40, kPanelHeight / 2), "Hit Ratio HR(n)", 13,
                                        Anchor::middle, kInk, true});
  }

  void shade(const Series& series) {
    std::vector<cv::Point2d> corners;
    const auto& interval = series.curve->interval;
    for (std::size_t i = 0; i < interval.size(); ++i)
      corners.push_back(at(static_cast<double>(i + 1), interval[i].high));
    for (std::size_t i = interval.size(); i-- > 0;)
      corners.push_back(at(static_cast<double>(i + 1), interval[i].low));
    drawing_.shapes.emplace_back(Area{corners, series.colour, 0.15});
  }

  void curve(const Series& series) {
    std::vector<cv::Point2d> points;
    for (std::size_t i = 0; i < series.curve->mean.size(); ++i)
      points.push_back(at(static_cast<double>(i + 1), series.curve->mean[i]));
    drawing_.shapes.emplace_back(Line{points, series.colour, 2, series.dash});
    if (series.marker < 0) return;
    // Every n would hide the line; each series has its own phase, so that markers do not lie on each other.
    const std::size_t step = points.size() > 12 ? 4 : 1;
    for (std::size_t i = step == 1 ? 0 : static_cast<std::size_t>(series.marker) % step; i < points.size();
         i += step)
      drawing_.shapes.emplace_back(Area{marker_corners(series.marker, points[i]), series.colour});
  }

  Drawing& drawing_;
  cv::Point2d origin_;
  int points_;
};

void draw_legend(Drawing& drawing, cv::Point2d corner, const std::vector<Series>& series) {
  cv::Point2d left = corner;
  for (const Series& s : series) {
    const cv::Point2d middle = left + cv::Point2d(15, -4);
    drawing.shapes.emplace_back(
        Line{{left + cv::Point2d(0, -4), left + cv::Point2d(30, -4)}, s.colour, 2, s.dash});
    if (s.marker >= 0) drawing.shapes.emplace_back(Area{marker_corners(s.marker, middle), s.colour});
    drawing.shapes.emplace_back(Text{left + cv::Point2d(38, 0), s.name, 12, Anchor::start, kInk});
    left.y += kLegendLine;
  }
}

// The curve of what is compared; the colour and marker of the number-th of `of` series.
Series series_of(const std::string& name, const Curve& curve, std::size_t number, std::size_t of) {
  Series series{
      name, &curve, kPalette[number % kPalette.size()], {0, 0}, static_cast<int>(number), of <= kMostShaded};
  if (number >= kPalette.size()) series.dash = {9, 3};
  return series;
}

void add_references(Panel& panel, const Statistics& statistics) {
  panel.series.insert(panel.series.begin(), {"upper bound", &statistics.bound, kInk, {7, 4}});
  panel.series.push_back({"centre (expected)", &statistics.centre, kGray, {8, 3}});
  panel.series.push_back({"random (expected)", &statistics.random, kGray, {2, 3}});
}

class Figure {
 public:
  Figure(const EvalPlan& plan, const Statistics& statistics)
      : plan_(plan), statistics_(statistics), conditions_(plan.conditions()) {}

  std::vector<Row> rows() const {
    Row models, kernels;
    for (const Selector selector : plan_.selectors) {
      for (const int kernel : plan_.kernels) models.panels.push_back(models_panel(kernel, selector));
      for (const std::string& model : plan_.models)
        if (kernels_matter(model)) kernels.panels.push_back(kernels_panel(model, selector));
    }
    // The panels of the kernels show all there is of a single model.
    if (plan_.models.size() == 1 && !kernels.panels.empty()) return wrapped({kernels});
    return wrapped({models, kernels});
  }

 private:
  const Curve& curve(const Condition& condition) const {
    const auto found = std::find(conditions_.begin(), conditions_.end(), condition);
    return statistics_.conditions[static_cast<std::size_t>(found - conditions_.begin())];
  }

  Panel models_panel(int kernel, Selector selector) const {
    Panel panel{fmt::format("k = {}, {}", kernel, to_string(selector)), {}};
    for (std::size_t i = 0; i < plan_.models.size(); ++i)
      panel.series.push_back(
          series_of(plan_.models[i], curve({plan_.models[i], kernel, selector}), i, plan_.models.size()));
    add_references(panel, statistics_);
    return panel;
  }

  Panel kernels_panel(const std::string& model, Selector selector) const {
    Panel panel{fmt::format("{}, {}", model, to_string(selector)), {}};
    for (std::size_t i = 0; i < plan_.kernels.size(); ++i)
      panel.series.push_back(series_of(fmt::format("k = {}", plan_.kernels[i]),
                                       curve({model, plan_.kernels[i], selector}), i, plan_.kernels.size()));
    add_references(panel, statistics_);
    return panel;
  }

  bool kernels_matter(const std::string& model) const {
    for (const Selector selector : plan_.selectors)
      for (const int kernel : plan_.kernels)
        if (curve({model, kernel, selector}).mean != curve({model, plan_.kernels[0], selector}).mean)
          return true;
    return false;
  }

  static std::vector<Row> wrapped(const std::vector<Row>& rows) {
    std::vector<Row> out;
    for (const Row& row : rows)
      for (std::size_t i = 0; i < row.panels.size(); ++i) {
        if (i % kPanelsInRow == 0) out.emplace_back();
        out.back().panels.push_back(row.panels[i]);
      }
    return out;
  }

  const EvalPlan& plan_;
  const Statistics& statistics_;
  std::vector<Condition> conditions_;
};

}  // namespace

Drawing draw_hit_ratios(const EvalPlan& plan, const Statistics& statistics) {
  const std::vector<Row> rows = Figure(plan, statistics).rows();
  constexpr double kHead = 34;
  std::size_t columns = 0;
  double height = kHead;
  Drawing drawing;
  for (const Row& row : rows) {
    columns = std::max(columns, row.panels.size());
    double x = kLeft;
    for (const Panel& panel : row.panels) {
      Axes(drawing, {x, height + kTop}, plan.points).draw(panel, x == kLeft);
      x += kPanelWidth + kGap + kLeft / 2;
    }
    draw_legend(drawing, {x - kLeft / 2, height + kTop + 12}, row.panels[0].series);
    const double legend = kTop + 12 + kLegendLine * static_cast<double>(row.panels[0].series.size());
    height += std::max(kTop + kPanelHeight + kBottom, legend);
  }
  drawing.width = kLeft / 2 + static_cast<double>(columns) * (kPanelWidth + kGap + kLeft / 2) + kLegendWidth;
  drawing.height = height + 10;
  bool shaded = false;
  for (const Row& row : rows)
    for (const Series& series : row.panels[0].series) shaded = shaded || series.shaded;
  drawing.shapes.emplace_back(
      Text{{kLeft, 28},
           fmt::format("Hit Ratio, {} image{}, {:.1f} objects each{}", statistics.images,
                       statistics.images == 1 ? "" : "s", statistics.objects_mean,
                       shaded ? "; shaded: 95 % interval" : ""),
           15,
           Anchor::start,
           kInk});
  return drawing;
}

}  // namespace saccade
