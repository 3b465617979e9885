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

void ReliabilityBuilder::add(const ConditionResult& result, int most) {
  std::set<int> hit, surely_hit;
  const auto& points = result.points;
  for (std::size_t i = 0; i < std::min(points.size(), static_cast<std::size_t>(most)); ++i) {
    const EvalPoint& point = points[i];
    if (!point.confidence || point.label == kVoid) continue;
    add_point(sums_, static_cast<double>(*point.confidence), point.label != 0);
    if (point.label == 0) continue;
    hit.insert(point.label);
    if (*point.confidence >= kProbablyObject) surely_hit.insert(point.label);
  }
  objects_ += hit.size();
  surely_found_ += surely_hit.size();
}

std::optional<Reliability> ReliabilityBuilder::result() const {
  if (sums_.points == 0) return std::nullopt;
  Reliability result = sums_;
  for (Reliability::Bin& bin : result.bins) {
    bin.confidence = share(bin.confidence, bin.points);
    bin.on_object = share(bin.on_object, bin.points);
  }
  result.brier = share(result.brier, result.points);
  result.precision = share(result.precision, result.sure);
  result.recall = share(static_cast<double>(surely_found_), objects_);
  return result;
}

}  // namespace saccade
