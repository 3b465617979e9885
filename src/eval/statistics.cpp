#include "eval/statistics.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

template <typename Row>
Table table_of(const std::vector<ImageResult>& images, Row row) {
  Table table;
  for (const ImageResult& image : images)
    if (!image.left_out) table.push_back(row(image));
  return table;
}

// share_of_bound() of each image in a row of one; 0 for an image without objects.
Table shares_of_bound(const EvalPlan& plan, const std::vector<ImageResult>& images, std::size_t condition) {
  return table_of(images, [&](const ImageResult& image) {
    return std::vector<double>{image.objects > 0 ? share_of_bound(plan, image, condition) : 0};
  });
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
    if (image.left_out) continue;
    const bool first = statistics.images++ == 0;
    statistics.without_objects += image.objects == 0;
    statistics.void_known += image.void_known;
    statistics.objects_mean += image.objects;
    statistics.objects_least = first ? image.objects : std::min(statistics.objects_least, image.objects);
    statistics.objects_most = std::max(statistics.objects_most, image.objects);
  }
  if (statistics.images == 0) throw std::invalid_argument("summarise: no image was evaluated");
  statistics.objects_mean /= static_cast<double>(statistics.images);
}

std::vector<PointShares> shares_of(const EvalPlan& plan, const std::vector<ImageResult>& images,
                                   std::size_t condition) {
  std::vector<PointShares> shares(static_cast<std::size_t>(plan.points));
  double count = 0;
  for (const ImageResult& image : images) {
    if (image.left_out) continue;
    ++count;
    const auto kinds = point_kinds(image.conditions[condition].hits(), plan.points);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const double n = static_cast<double>(i) + 1;
      shares[i].new_object += kinds[i].new_object / n;
      shares[i].same_object += kinds[i].same_object / n;
      shares[i].structure += kinds[i].structure / n;
      shares[i].unlabelled += kinds[i].unlabelled / n;
      shares[i].missing += kinds[i].missing / n;
    }
  }
  for (PointShares& share : shares)
    for (double* value :
         {&share.new_object, &share.same_object, &share.structure, &share.unlabelled, &share.missing})
      *value /= count;
  return shares;
}

// Rows 0, 2, 4, .. (half 0) or 1, 3, 5, .. (half 1).
Table half_of(const Table& table, std::size_t half) {
  Table rows;
  for (std::size_t i = half; i < table.size(); i += 2) rows.push_back(table[i]);
  return rows;
}

std::array<std::vector<double>, 2> means_of_halves(const Table& table) {
  std::array<std::vector<double>, 2> means;
  for (const std::size_t half : {0U, 1U})
    if (const Table rows = half_of(table, half); !rows.empty()) means[half] = column_means(rows);
  return means;
}

// The condition of `model` with the highest sum of shares of the bound on one half of the images; the first
// of equals.
std::size_t best_on_half(const EvalPlan& plan, const std::vector<ImageResult>& images,
                         const std::string& model, std::size_t half) {
  const auto conditions = plan.conditions();
  std::optional<std::size_t> best;
  double highest = 0;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (conditions[i].model != model) continue;
    double sum = 0;
    for (const auto& row : half_of(shares_of_bound(plan, images, i), half)) sum += row[0];
    if (!best || sum > highest) {
      best = i;
      highest = sum;
    }
  }
  return *best;
}

CrossValidation cross_validate(const EvalPlan& plan, const std::vector<ImageResult>& images,
                               const std::string& model) {
  CrossValidation result{
      model, {best_on_half(plan, images, model, 1), best_on_half(plan, images, model, 0)}, {}};
  Table rows = hit_ratios(plan, images, result.used[0]);
  const Table odd = hit_ratios(plan, images, result.used[1]);
  for (std::size_t i = 1; i < rows.size(); i += 2) rows[i] = odd[i];
  result.curve = curve_of(rows);
  return result;
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
    return hit_ratio(image.conditions[condition].hits(), plan.points);
  });
}

double share_of_bound(const EvalPlan& plan, const ImageResult& image, std::size_t condition) {
  constexpr int kPoints = 10;
  const int points = std::min(plan.points, kPoints);
  const auto ratio = hit_ratio(image.conditions[condition].hits(), points);
  const auto bound = hit_ratio_bound(image.objects, points);
  double sum = 0;
  for (std::size_t i = 0; i < ratio.size(); ++i) sum += ratio[i] / bound[i];
  return sum / points;
}

Table void_neutral_hit_ratios(const EvalPlan& plan, const std::vector<ImageResult>& images,
                              std::size_t condition) {
  return table_of(images, [&](const ImageResult& image) {
    return hit_ratio(without_void(image.conditions[condition].hits()), plan.points);
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
    statistics.halves.push_back(means_of_halves(table));
    statistics.points_on.push_back(shares_of(plan, images, i));
    statistics.reliability.push_back(reliability_of(plan, images, i));
    if (statistics.void_known > 0)
      statistics.void_neutral.push_back(curve_of(void_neutral_hit_ratios(plan, images, i)));
    const auto most = static_cast<std::size_t>(plan.points);
    statistics.points_mean.push_back(mean_of(
        images, i, [&](const auto& r) { return static_cast<double>(std::min(r.points.size(), most)); }));
    statistics.map_ms.push_back(mean_of(images, i, [](const auto& r) { return r.map_ms; }));
    statistics.select_ms.push_back(mean_of(images, i, [](const auto& r) { return r.select_ms; }));
  }
  for (std::size_t a = 0; a < conditions.size(); ++a)
    for (std::size_t b = a + 1; b < conditions.size(); ++b)
      if (differ_in_one(conditions[a], conditions[b]))
        statistics.differences.push_back(
            difference_of(a, b, statistics.conditions, resampled, shown_counts(plan.points)));
  for (const std::string& model : plan.models)
    statistics.cross_validations.push_back(cross_validate(plan, images, model));
  return statistics;
}

}  // namespace saccade
