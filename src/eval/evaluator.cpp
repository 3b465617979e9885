#include "eval/evaluator.hpp"

#include <chrono>

#include "core/error.hpp"
#include "eval/hit_ratio.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// Some data sets label objects of a class that they do not name: an object is never void.
int label_at(const GroundTruth& truth, cv::Point pixel) {
  const int label = truth.labels(pixel);
  return label == 0 && !truth.classes.empty() && truth.classes(pixel) == 0 ? kVoid : label;
}

}  // namespace

std::vector<int> ConditionResult::hits() const {
  std::vector<int> labels;
  for (const EvalPoint& point : points) labels.push_back(point.label);
  return labels;
}

Evaluator::Evaluator(const EvalPlan& plan, WorkerPool& pool) : points_(plan.points) {
  for (const Condition& condition : plan.conditions()) {
    const Settings settings = plan.settings_of(condition);
    Settings larger = settings;
    larger.fixations *= kVoidReserve;
    const bool same_map = !methods_.empty() && methods_.back().condition.model == condition.model &&
                          methods_.back().condition.kernel == condition.kernel;
    methods_.push_back({condition, same_map ? methods_.back().model : make_model(settings, pool),
                        make_selector(settings), make_selector(larger)});
  }
}

ConditionResult Evaluator::measure(const Frame& frame, std::size_t condition) {
  const Method& method = methods_[condition];
  if (condition == 0 || methods_[condition - 1].model != method.model) {
    StageTimes unused;
    const auto begin = Clock::now();
    method.model->compute(frame, {}, current_.maps, unused);
    map_ms_ = ms_since(begin);
  }
  const bool void_known = !frame.truth.classes.empty();
  AttentionSelector& selector = void_known ? *method.larger_selector : *method.selector;
  const auto begin = Clock::now();
  selector.select(current_.maps.master, frame.depth_mm, frame.intrinsics, current_.attention);
  ConditionResult result{{}, map_ms_, ms_since(begin)};
  for (const Fixation& fixation : current_.attention.fixations)
    result.points.push_back({fixation.row, fixation.col, label_at(frame.truth, {fixation.col, fixation.row}),
                             fixation.confidence});
  return result;
}

ImageResult Evaluator::evaluate(const Frame& frame) {
  ImageResult result;
  result.frame = frame.index;
  result.name = frame.name;
  if (frame.truth.labels.empty()) {
    result.left_out = "it has no label image";
    return result;
  }
  result.void_known = !frame.truth.classes.empty();
  result.objects = static_cast<int>(object_areas(frame.truth.labels).size());
  result.random = random_hit_ratio(frame.truth.labels, points_);
  result.centre = centre_hit_ratio(frame.truth.labels, points_);
  try {
    for (std::size_t i = 0; i < methods_.size(); ++i) result.conditions.push_back(measure(frame, i));
  } catch (const Error& error) {
    if (error.status() != ExitStatus::unreadable) throw;
    result.left_out = error.what();
    result.conditions.clear();
  }
  return result;
}

const MapAndPoints& Evaluator::compute(const Frame& frame, std::size_t condition) {
  const Method& method = methods_.at(condition);
  StageTimes unused;
  method.model->compute(frame, {}, current_.maps, unused);
  method.selector->select(current_.maps.master, frame.depth_mm, frame.intrinsics, current_.attention);
  return current_;
}

}  // namespace saccade
