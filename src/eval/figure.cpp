#include "eval/figure.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "eval/chart.hpp"

namespace saccade {
namespace {

constexpr double kPanelWidth = 380, kPanelHeight = 280, kPanelBottom = 52, kGap = 24;
constexpr double kLegendWidth = 190;
constexpr std::size_t kPanelsInRow = 4, kMostShaded = 4;

struct Series {
  SeriesStyle style;
  const Curve* curve = nullptr;
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
    drawing_.shapes.emplace_back(Area{corners, series.style.colour, 0.15});
  }

  void curve(const Series& series) {
    std::vector<cv::Point2d> points;
    for (std::size_t i = 0; i < series.curve->mean.size(); ++i)
      points.push_back(at(static_cast<double>(i + 1), series.curve->mean[i]));
    drawing_.shapes.emplace_back(Line{points, series.style.colour, 2, series.style.dash});
    if (series.style.marker < 0) return;
    // Every n would hide the line; each series has its own phase, so that markers do not lie on each other.
    const std::size_t step = points.size() > 12 ? 4 : 1;
    for (std::size_t i = step == 1 ? 0 : static_cast<std::size_t>(series.style.marker) % step;
         i < points.size(); i += step)
      drawing_.shapes.emplace_back(Area{marker_corners(series.style.marker, points[i]), series.style.colour});
  }

  Drawing& drawing_;
  cv::Point2d origin_;
  int points_;
};

// The curve of what is compared; the colour and marker of the number-th of `of` series.
Series series_of(const std::string& name, const Curve& curve, std::size_t number, std::size_t of) {
  return {style_of(name, number), &curve, of <= kMostShaded};
}

std::vector<SeriesStyle> styles_of(const Panel& panel) {
  std::vector<SeriesStyle> styles;
  for (const Series& series : panel.series) styles.push_back(series.style);
  return styles;
}

void add_references(Panel& panel, const Statistics& statistics) {
  panel.series.insert(panel.series.begin(), {{"upper bound", kInk, {7, 4}}, &statistics.bound});
  panel.series.push_back({{"centre (expected)", kGray, {8, 3}}, &statistics.centre});
  panel.series.push_back({{"random (expected)", kGray, {2, 3}}, &statistics.random});
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
    double x = kChartLeft;
    for (const Panel& panel : row.panels) {
      Axes(drawing, {x, height + kChartTop}, plan.points).draw(panel, x == kChartLeft);
      x += kPanelWidth + kGap + kChartLeft / 2;
    }
    draw_legend(drawing, {x - kChartLeft / 2, height + kChartTop + 12}, styles_of(row.panels[0]));
    const double legend = kChartTop + 12 + kLegendLine * static_cast<double>(row.panels[0].series.size());
    height += std::max(kChartTop + kPanelHeight + kPanelBottom, legend);
  }
  drawing.width =
      kChartLeft / 2 + static_cast<double>(columns) * (kPanelWidth + kGap + kChartLeft / 2) + kLegendWidth;
  drawing.height = height + 10;
  bool shaded = false;
  for (const Row& row : rows)
    for (const Series& series : row.panels[0].series) shaded = shaded || series.shaded;
  drawing.shapes.emplace_back(
      Text{{kChartLeft, 28},
           fmt::format("Hit Ratio, {}, {:.1f} objects each{}", counted(statistics.images, "image"),
                       statistics.objects_mean, shaded ? "; shaded: 95 % interval" : ""),
           15,
           Anchor::start,
           kInk});
  return drawing;
}

}  // namespace saccade
