#include "eval/statistics.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>

#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

bool differ_in_one(const Condition& a, const Condition& b) {
  return (a.model != b.model) + (a.kernel != b.kernel) + (a.selector != b.selector) == 1;
}

void add_shares(std::vector<PointShares>& shares, const std::vector<PointKinds>& kinds) {
  shares.resize(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const double n = static_cast<double>(i) + 1;
    shares[i].new_object += kinds[i].new_object / n;
    shares[i].same_object += kinds[i].same_object / n;
    shares[i].structure += kinds[i].structure / n;
    shares[i].unlabelled += kinds[i].unlabelled / n;
    shares[i].missing += kinds[i].missing / n;
  }
}

std::vector<PointShares> means_of(std::vector<PointShares> sums, double count) {
  for (PointShares& share : sums)
    for (double* value :
         {&share.new_object, &share.same_object, &share.structure, &share.unlabelled, &share.missing})
      *value /= count;
  return sums;
}

std::array<std::vector<double>, 2> means_of(const std::array<Moments, 2>& halves) {
  std::array<std::vector<double>, 2> means;
  for (const std::size_t half : {0U, 1U})
    if (halves[half].rows > 0) means[half] = halves[half].mean();
  return means;
}

}  // namespace

std::vector<int> shown_counts(int points) {
  std::vector<int> counts;
  for (const int n : {1, 2, 3, 5, 10, 20, 30})
    if (n <= points) counts.push_back(n);
  if (counts.back() != points) counts.push_back(points);
  return counts;
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

StatisticsBuilder::StatisticsBuilder(const EvalPlan& plan)
    : plan_(plan),
      conditions_(plan.conditions()),
      counts_(shown_counts(plan.points)),
      of_condition_(conditions_.size()),
      rows_(conditions_.size()) {
  for (std::size_t a = 0; a < conditions_.size(); ++a)
    for (std::size_t b = a + 1; b < conditions_.size(); ++b)
      if (differ_in_one(conditions_[a], conditions_[b])) pairs_.push_back({a, b, {}});
}

void StatisticsBuilder::add(const ImageResult& image) {
  if (image.left_out) {
    if (counted_.images_left_out++ < kMostNamed)
      counted_.left_out.push_back({image.frame, image.name, *image.left_out});
    return;
  }
  for (std::size_t i = 0; i < conditions_.size(); ++i) add_condition(image, i);
  add_differences();
  bound_.add(hit_ratio_bound(image.objects, plan_.points));
  random_.add(image.random);
  centre_.add(image.centre);
  count(image);
}

void StatisticsBuilder::count(const ImageResult& image) {
  const bool first = counted_.images++ == 0;
  counted_.without_objects += image.objects == 0;
  counted_.void_known += image.void_known;
  counted_.objects_mean += image.objects;
  counted_.objects_least = first ? image.objects : std::min(counted_.objects_least, image.objects);
  counted_.objects_most = std::max(counted_.objects_most, image.objects);
}

void StatisticsBuilder::add_condition(const ImageResult& image, std::size_t condition) {
  OfCondition& sums = of_condition_[condition];
  const ConditionResult& result = image.conditions[condition];
  const std::vector<int> hits = result.hits();
  rows_[condition] = hit_ratio(hits, plan_.points);
  sums.hit_ratio.add(rows_[condition]);
  sums.void_neutral.add(hit_ratio(without_void(hits), plan_.points));
  add_shares(sums.points_on, point_kinds(hits, plan_.points));
  sums.reliability.add(result, plan_.points);
  if (image.objects > 0) sums.share_of_bound[counted_.images % 2] += share_of_bound(plan_, image, condition);
  sums.points += static_cast<double>(std::min(result.points.size(), static_cast<std::size_t>(plan_.points)));
  sums.map_ms += result.map_ms;
  sums.select_ms += result.select_ms;
}

void StatisticsBuilder::add_differences() {
  std::vector<double> difference(counts_.size());
  for (Pair& pair : pairs_) {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const auto n = static_cast<std::size_t>(counts_[i] - 1);
      difference[i] = rows_[pair.a][n] - rows_[pair.b][n];
    }
    pair.difference.add(difference);
  }
}

Statistics StatisticsBuilder::result() const {
  if (counted_.images == 0) throw std::invalid_argument("Statistics: no image was evaluated");
  Statistics statistics = counted_;
  const auto images = static_cast<double>(counted_.images);
  statistics.objects_mean /= images;
  statistics.bound = curve_of(bound_);
  statistics.random = curve_of(random_);
  statistics.centre = curve_of(centre_);
  std::vector<Table> samples;  // of each condition, if its rows are kept
  for (const OfCondition& sums : of_condition_) {
    const Sample& hit_ratio = sums.hit_ratio;
    if (hit_ratio.is_kept()) samples.push_back(resampled(hit_ratio.rows()));
    statistics.conditions.push_back(hit_ratio.is_kept() ? curve_of(hit_ratio.rows(), samples.back())
                                                        : curve_of(hit_ratio.all()));
    statistics.halves.push_back(means_of(hit_ratio.halves()));
    statistics.points_on.push_back(means_of(sums.points_on, images));
    statistics.reliability.push_back(sums.reliability.result());
    if (counted_.void_known > 0) statistics.void_neutral.push_back(curve_of(sums.void_neutral));
    statistics.points_mean.push_back(sums.points / images);
    statistics.map_ms.push_back(sums.map_ms / images);
    statistics.select_ms.push_back(sums.select_ms / images);
  }
  for (const Pair& pair : pairs_) statistics.differences.push_back(difference_of(pair, samples));
  for (const std::string& model : plan_.models) statistics.cross_validations.push_back(cross_validate(model));
  return statistics;
}

// `samples`: resampled means of each condition; empty if the rows are not kept.
Difference StatisticsBuilder::difference_of(const Pair& pair, const std::vector<Table>& samples) const {
  Difference difference{pair.a, pair.b, {}, {}};
  const std::vector<double> a = of_condition_[pair.a].hit_ratio.all().mean(),
                            b = of_condition_[pair.b].hit_ratio.all().mean();
  for (const int count : counts_) {
    const auto n = static_cast<std::size_t>(count - 1);
    difference.mean.push_back(a[n] - b[n]);
    if (samples.empty()) continue;
    std::vector<double> of_a = column(samples[pair.a], n);
    const std::vector<double> of_b = column(samples[pair.b], n);
    std::transform(of_a.begin(), of_a.end(), of_b.begin(), of_a.begin(), std::minus<>());
    difference.interval.push_back(central_95(std::move(of_a)));
  }
  if (samples.empty()) difference.interval = pair.difference.normal_95();
  return difference;
}

// The condition of `model` with the highest sum of shares of the bound on one half of the images; the first
// of equals.
std::size_t StatisticsBuilder::best_on_half(const std::string& model, std::size_t half) const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < conditions_.size(); ++i)
    if (conditions_[i].model == model &&
        (!best || of_condition_[i].share_of_bound[half] > of_condition_[*best].share_of_bound[half]))
      best = i;
  return *best;
}

CrossValidation StatisticsBuilder::cross_validate(const std::string& model) const {
  CrossValidation result{model, {best_on_half(model, 1), best_on_half(model, 0)}, {}};
  const Sample &even = of_condition_[result.used[0]].hit_ratio,
               &odd = of_condition_[result.used[1]].hit_ratio;
  if (!even.is_kept()) {
    result.curve = curve_of(even.halves()[0] + odd.halves()[1]);
    return result;
  }
  Table rows = even.rows();
  for (std::size_t i = 1; i < rows.size(); i += 2) rows[i] = odd.rows()[i];
  result.curve = curve_of(rows, resampled(rows));
  return result;
}

}  // namespace saccade
