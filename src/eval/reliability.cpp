#include "eval/reliability.hpp"

#include <algorithm>
#include <set>

#include "attention/confidence.hpp"
#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

// Sums over points, as which Reliability's means begin.
void add_point(Reliability& sums, double confidence, bool on_object) {
  const auto place = static_cast<std::size_t>(confidence * Reliability::kBins);
  Reliability::Bin& bin = sums.bins[std::min(place, Reliability::kBins - 1)];
  const double truth = on_object ? 1 : 0, error = confidence - truth;
  ++bin.points;
  bin.confidence += confidence;
  bin.on_object += truth;
  ++sums.points;
  sums.brier += error * error;
  if (confidence < static_cast<double>(kProbablyObject)) return;
  ++sums.sure;
  sums.precision += truth;
}

double share(double sum, std::size_t of) { return of > 0 ? sum / static_cast<double>(of) : 0; }

}  // namespace

std::optional<Reliability> reliability_of(const EvalPlan& plan, const std::vector<ImageResult>& images,
                                          std::size_t condition) {
  Reliability result;
  std::size_t objects = 0, found = 0;
  for (const ImageResult& image : images) {
    if (image.left_out) continue;
    std::set<int> hit, surely_hit;
    const auto& points = image.conditions[condition].points;
    for (std::size_t i = 0; i < std::min(points.size(), static_cast<std::size_t>(plan.points)); ++i) {
      const EvalPoint& point = points[i];
      if (!point.confidence || point.label == kVoid) continue;
      add_point(result, static_cast<double>(*point.confidence), point.label != 0);
      if (point.label == 0) continue;
      hit.insert(point.label);
      if (*point.confidence >= kProbablyObject) surely_hit.insert(point.label);
    }
    objects += hit.size();
    found += surely_hit.size();
  }
  if (result.points == 0) return std::nullopt;
  for (Reliability::Bin& bin : result.bins) {
    bin.confidence = share(bin.confidence, bin.points);
    bin.on_object = share(bin.on_object, bin.points);
  }
  result.brier = share(result.brier, result.points);
  result.precision = share(result.precision, result.sure);
  result.recall = share(static_cast<double>(found), objects);
  return result;
}

}  // namespace saccade
