#include "eval/page.hpp"

#include <fmt/format.h>

#include "eval/hit_ratio.hpp"
#include "eval/markup.hpp"

namespace saccade {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Saccade: Hit Ratio</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font-family: Helvetica, Arial, sans-serif; color: #282828; margin: 2em; max-width: 130em; }
svg { max-width: 100%; height: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 0.3em 0.8em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
td small { color: #777; display: block; }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(20em, 1fr)); gap: 1em; }
figure { margin: 0; } figure img { width: 100%; display: block; }
figcaption { font-size: 0.9em; padding-top: 0.3em; }
</style></head><body>
)";

std::string table_row(const std::string& name, const Curve& curve, const std::vector<int>& counts) {
  std::string row = "<tr><td>" + escaped(name) + "</td>";
  for (const int count : counts) {
    const auto n = static_cast<std::size_t>(count - 1);
    row += fmt::format("<td>{:.3f}<small>{:.3f} to {:.3f}</small></td>", curve.mean[n], curve.interval[n].low,
                       curve.interval[n].high);
  }
  return row + "</tr>\n";
}

std::string table(const EvalPlan& plan, const Statistics& statistics) {
  const auto counts = shown_counts(plan.points);
  std::string html = "<table><tr><th>n</th>";
  for (const int n : counts) html += fmt::format("<th>{}</th>", n);
  html += "</tr>\n" + table_row("upper bound", statistics.bound, counts);
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i)
    html += table_row(describe(conditions[i]), statistics.conditions[i], counts);
  html += table_row("centre (expected)", statistics.centre, counts);
  return html + table_row("random (expected)", statistics.random, counts) + "</table>\n";
}

std::string figure_of(const EvalPlan& plan, const Example& example) {
  const ImageResult& image = *example.image;
  std::vector<int> hits;
  for (const EvalPoint& point : image.conditions[example.condition].points) hits.push_back(point.label);
  const int points = std::min(plan.points, 10);
  const int found = objects_found(hits, points).back();
  return fmt::format(
      "<figure><img src=\"{}\" alt=\"\" loading=\"lazy\"><figcaption><b>frame {}{}</b>: {} of {} objects "
      "with "
      "{} points, {:.0f} % of the bound</figcaption></figure>\n",
      example.file, image.frame, image.name.empty() ? "" : " (" + escaped(image.name) + ")", found,
      image.objects, points, 100 * example.share);
}

std::string sheets(const EvalPlan& plan, const std::vector<Example>& examples) {
  std::string html;
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < examples.size(); ++i) {
    const bool first = i == 0 || examples[i].condition != examples[i - 1].condition;
    const bool turn = first || examples[i].best != examples[i - 1].best;
    if (turn && i > 0) html += "</div>\n";
    if (first) html += "<h2>" + escaped(describe(conditions[examples[i].condition])) + "</h2>\n";
    if (turn)
      html += fmt::format("<h3>{} images</h3>\n<div class=\"sheet\">\n", examples[i].best ? "Best" : "Worst");
    html += figure_of(plan, examples[i]);
  }
  return html.empty() ? html : html + "</div>\n";
}

std::string left_out(const std::vector<ImageResult>& images) {
  std::string items;
  for (const ImageResult& image : images)
    if (!image.left_out.empty())
      items +=
          fmt::format("<li>frame {}{}: {}</li>\n", image.frame,
                      image.name.empty() ? "" : " (" + escaped(image.name) + ")", escaped(image.left_out));
  return items.empty() ? "" : "<h2>Left out</h2>\n<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string page_html(const EvalPlan& plan, const std::vector<ImageResult>& images,
                      const Statistics& statistics, const std::string& svg,
                      const std::vector<Example>& examples) {
  std::string html = kHead;
  html += fmt::format("<h1>Hit Ratio on {}</h1>\n", escaped(plan.dataset));
  html += fmt::format(
      "<p>{} images with {:.1f} labelled objects on average ({} to {}). HR(n) is the number of different "
      "objects that the first n points hit, divided by n; small figures are 95 % intervals over "
      "images.</p>\n",
      statistics.images, statistics.objects_mean, statistics.objects_least, statistics.objects_most);
  html += svg + table(plan, statistics);
  if (!examples.empty())
    html +=
        "<p>Below, for each model, the images where it comes nearest to the bound and where it stays "
        "farthest "
        "from it, under the kernel and selector that suit it best. Outlined are the labelled objects: white "
        "where one of the first ten points hit, red where none did.</p>\n";
  return html + sheets(plan, examples) + left_out(images) + "</body></html>\n";
}

}  // namespace saccade
