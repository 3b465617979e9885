#include "eval/page.hpp"

#include <fmt/format.h>

#include "attention/confidence.hpp"
#include "core/text.hpp"
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

std::string hit_ratio_table(const EvalPlan& plan, const Statistics& statistics) {
  const auto counts = shown_counts(plan.points);
  std::string html = "<table><tr><th>n</th>";
  for (const int n : counts) html += fmt::format("<th>{}</th>", n);
  html += "</tr>\n" + table_row("upper bound", statistics.bound, counts);
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    html += table_row(describe(conditions[i]), statistics.conditions[i], counts);
    if (statistics.void_known > 0)
      html += table_row(describe(conditions[i]) + ", void-neutral", statistics.void_neutral[i], counts);
  }
  for (const CrossValidation& c : statistics.cross_validations)
    if (plan.kernels.size() * plan.selectors.size() > 1)
      html += table_row(c.model + ", cross-validated", c.curve, counts);
  html += table_row("centre (expected)", statistics.centre, counts);
  return html + table_row("random (expected)", statistics.random, counts) + "</table>\n";
}

// One cell: the shares of the first n points in percent.
std::string shares_cell(const PointShares& share, bool void_known) {
  const auto percent = [](double value) { return fmt::format("{:.0f}", 100 * value); };
  std::string cell = "<td>" + percent(share.new_object) + "<small>" + percent(share.same_object) + " / " +
                     percent(share.structure);
  if (void_known) cell += " / " + percent(share.unlabelled);
  if (share.missing > 0) cell += ", missing " + percent(share.missing);
  return cell + "</small></td>";
}

std::string points_on_table(const EvalPlan& plan, const Statistics& statistics) {
  const auto counts = shown_counts(plan.points);
  const bool void_known = statistics.void_known > 0;
  std::string html = fmt::format(
      "<h2>What the points lie on</h2>\n<p>Percent of the first n points on a new object; below, on an "
      "object "
      "that an earlier point hit / on no object, such as a wall or a table{}.</p>\n<table><tr><th>n</th>",
      void_known ? " / on void, which nobody labelled" : "");
  for (const int n : counts) html += fmt::format("<th>{}</th>", n);
  html += "</tr>\n";
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    html += "<tr><td>" + escaped(describe(conditions[i])) + "</td>";
    for (const int n : counts)
      html += shares_cell(statistics.points_on[i][static_cast<std::size_t>(n - 1)], void_known);
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string reliability_section(const EvalPlan& plan, const Statistics& statistics, const std::string& svg) {
  std::string html = fmt::format(
      "<h2>Confidence</h2>\n<p>The confidence of a point is the probability that it lies on an object; "
      "points "
      "on void are left out. Precision: the share of the points with a confidence of at least {0} that lies "
      "on "
      "objects. Recall: the share of the objects hit by any point that these points hit.</p>\n{1}"
      "<table><tr><th></th><th>points</th><th>at least {0}</th><th>precision</th><th>recall</th><th>Brier "
      "score</th></tr>\n",
      kProbablyObject, svg);
  const auto conditions = plan.conditions();
  for (std::size_t i = 0; i < conditions.size(); ++i)
    if (const auto& r = statistics.reliability[i])
      html += fmt::format(
          "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.3f}</td><td>{:.3f}</td><td>{:.3f}</td></tr>\n",
          escaped(describe(conditions[i])), r->points, r->sure, r->precision, r->recall, r->brier);
  return html + "</table>\n";
}

std::string figure_of(const EvalPlan& plan, const Example& example) {
  const int points = std::min(plan.points, 10);
  const int found = objects_found(example.result.hits(), points).back();
  return fmt::format(
      "<figure><img src=\"{}\" alt=\"\" loading=\"lazy\"><figcaption><b>frame {}{}</b>: {} of {} "
      "with {}, {:.0f} % of the bound</figcaption></figure>\n",
      example.file, example.frame, example.name.empty() ? "" : " (" + escaped(example.name) + ")", found,
      counted(example.objects, "object"), counted(points, "point"), 100 * example.share);
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

std::string left_out(const Statistics& statistics) {
  std::string items;
  for (const LeftOut& image : statistics.left_out)
    items += fmt::format("<li>frame {}{}: {}</li>\n", image.frame,
                         image.name.empty() ? "" : " (" + escaped(image.name) + ")", escaped(image.reason));
  if (statistics.images_left_out > statistics.left_out.size())
    items += fmt::format("<li>{} more, in results.jsonl</li>\n",
                         statistics.images_left_out - statistics.left_out.size());
  return items.empty() ? "" : "<h2>Left out</h2>\n<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string page_html(const EvalPlan& plan, const Statistics& statistics, const PageFigures& figures,
                      const std::vector<Example>& examples) {
  std::string html = kHead;
  html += fmt::format("<h1>Hit Ratio on {}</h1>\n", escaped(plan.dataset));
  if (!plan.missing.empty()) html += fmt::format("<p><b>Partial:</b> {}.</p>\n", escaped(plan.missing));
  html += fmt::format(
      "<p>{} with {:.1f} labelled objects on average ({} to {}). HR(n) is the number of different "
      "objects that the first n points hit, divided by n; small figures are 95 % intervals over "
      "images. A cross-validated model uses, on each half of the images, the kernel and selector that are "
      "best on the other half.</p>\n",
      counted(statistics.images, "image"), statistics.objects_mean, statistics.objects_least,
      statistics.objects_most);
  if (statistics.void_known > 0)
    html += fmt::format(
        "<p>Void is what nobody labelled, known in {} of the images; in the void-neutral Hit Ratio points on "
        "void do not count and the next ones take their place.</p>\n",
        statistics.void_known);
  html += figures.hit_ratios + hit_ratio_table(plan, statistics) + points_on_table(plan, statistics);
  if (!figures.reliability.empty()) html += reliability_section(plan, statistics, figures.reliability);
  if (!examples.empty())
    html +=
        "<p>The images on which each model comes closest to the bound and stays farthest from it, under its "
        "best kernel and selector. Outlines show the labelled objects: white where one of the first ten "
        "points hit, red where none did.</p>\n";
  return html + sheets(plan, examples) + left_out(statistics) + "</body></html>\n";
}

}  // namespace saccade
