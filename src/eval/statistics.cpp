#include "eval/statistics.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

template <typename Row>
Table table_of(const std::vector<ImageResult>& images, Row row) {
  Table table;
  for (const ImageResult& image : images)
    if (image.left_out.empty()) table.push_back(row(image));
  return table;
}

std::vector<double> column(const Table& table, std::size_t n) {
  std::vector<double> values;
  for (const auto& row : table) values.push_back(row[n]);
  return values;
}

Curve curve_of(const Table& table, const Table& resampled) {
  Curve curve{column_means(table), {}};
  for (std::size_t n = 0; n < curve.mean.size(); ++n)
    curve.interval.push_back(central_95(column(resampled, n)));
  return curve;
}

Curve curve_of(const Table& table) {
  return curve_of(table, resampled_means(table, kResamples, kBootstrapSeed));
}

bool differ_in_one(const Condition& a, const Condition& b) {
  return (a.model != b.model) + (a.kernel != b.kernel) + (a.selector != b.selector) == 1;
}

Difference difference_of(std::size_t a, std::size_t b, const std::vector<Curve>& curves,
                         const std::vector<Table>& resampled, const std::vector<int>& counts) {
  Difference difference{a, b, {}, {}};
  for (const int count : counts) {
    const auto n = static_cast<std::size_t>(count - 1);
    std::vector<double> of_a = column(resampled[a], n);
    const std::vector<double> of_b = column(resampled[b], n);
    std::transform(of_a.begin(), of_a.end(), of_b.begin(), of_a.begin(), std::minus<>());
    difference.mean.push_back(curves[a].mean[n] - curves[b].mean[n]);
    difference.interval.push_back(central_95(std::move(of_a)));
  }
  return difference;
}

void count_objects(const std::vector<ImageResult>& images, Statistics& statistics) {
  for (const ImageResult& image : images) {
    if (!image.left_out.empty()) continue;
    const bool first = statistics.images++ == 0;
    statistics.without_objects += image.objects == 0;
    statistics.objects_mean += image.objects;
    statistics.objects_least = first ? image.objects : std::min(statistics.objects_least, image.objects);
    statistics.objects_most = std::max(statistics.objects_most, image.objects);
  }
  if (statistics.images == 0) throw std::invalid_argument("summarise: no image was evaluated");
  statistics.objects_mean /= static_cast<double>(statistics.images);
}

double mean_of(const std::vector<ImageResult>& images, std::size_t condition,
               const std::function<double(const ConditionResult&)>& value) {
  return column_means(table_of(images, [&](const ImageResult& image) {
    return std::vector<double>{value(image.conditions[condition])};
  }))[0];
}

}  // namespace

std::vector<int> shown_counts(int points) {
  std::vector<int> counts;
  for (const int n : {1, 2, 3, 5, 10, 20, 30})
    if (n <= points) counts.push_back(n);
  if (counts.back() != points) counts.push_back(points);
  return counts;
}

Table hit_ratios(const EvalPlan& plan, const std::vector<ImageResult>& images, std::size_t condition) {
  return table_of(images, [&](const ImageResult& image) {
    std::vector<int> hits;
    for (const EvalPoint& point : image.conditions[condition].points) hits.push_back(point.label);
    return hit_ratio(hits, plan.points);
  });
}

Statistics summarise(const EvalPlan& plan, const std::vector<ImageResult>& images) {
  Statistics statistics;
  count_objects(images, statistics);
  statistics.bound = curve_of(table_of(
      images, [&](const ImageResult& image) { return hit_ratio_bound(image.objects, plan.points); }));
  statistics.random = curve_of(table_of(images, [](const ImageResult& image) { return image.random; }));
  statistics.centre = curve_of(table_of(images, [](const ImageResult& image) { return image.centre; }));

  const std::vector<Condition> conditions = plan.conditions();
  std::vector<Table> resampled;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const Table table = hit_ratios(plan, images, i);
    resampled.push_back(resampled_means(table, kResamples, kBootstrapSeed));
    statistics.conditions.push_back(curve_of(table, resampled.back()));
    statistics.points_mean.push_back(
        mean_of(images, i, [](const auto& r) { return static_cast<double>(r.points.size()); }));
    statistics.map_ms.push_back(mean_of(images, i, [](const auto& r) { return r.map_ms; }));
    statistics.select_ms.push_back(mean_of(images, i, [](const auto& r) { return r.select_ms; }));
  }
  for (std::size_t a = 0; a < conditions.size(); ++a)
    for (std::size_t b = a + 1; b < conditions.size(); ++b)
      if (differ_in_one(conditions[a], conditions[b]))
        statistics.differences.push_back(
            difference_of(a, b, statistics.conditions, resampled, shown_counts(plan.points)));
  return statistics;
}

}  // namespace saccade
