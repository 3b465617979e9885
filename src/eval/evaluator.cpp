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

}  // namespace

Evaluator::Evaluator(const EvalPlan& plan, WorkerPool& pool) : points_(plan.points) {
  for (const Condition& condition : plan.conditions()) {
    const Settings settings = plan.settings_of(condition);
    const bool same_map = !ways_.empty() && ways_.back().condition.model == condition.model &&
                          ways_.back().condition.kernel == condition.kernel;
    ways_.push_back(
        {condition, same_map ? ways_.back().model : make_model(settings, pool), make_selector(settings)});
  }
}

ConditionResult Evaluator::measure(const Frame& frame, std::size_t condition) {
  const Way& way = ways_[condition];
  if (condition == 0 || ways_[condition - 1].model != way.model) {
    StageTimes unused;
    const auto begin = Clock::now();
    way.model->compute(frame, {}, look_.maps, unused);
    map_ms_ = ms_since(begin);
  }
  const auto begin = Clock::now();
  way.selector->select(look_.maps.master, frame.depth_mm, frame.intrinsics, look_.attention);
  ConditionResult result{{}, map_ms_, ms_since(begin)};
  for (const Fixation& fixation : look_.attention.fixations) {
    if (result.points.size() == static_cast<std::size_t>(points_)) break;
    result.points.push_back({fixation.row, fixation.col, frame.truth.labels(fixation.row, fixation.col)});
  }
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
  result.objects = static_cast<int>(object_areas(frame.truth.labels).size());
  result.random = random_hit_ratio(frame.truth.labels, points_);
  result.centre = centre_hit_ratio(frame.truth.labels, points_);
  try {
    for (std::size_t i = 0; i < ways_.size(); ++i) result.conditions.push_back(measure(frame, i));
  } catch (const Error& error) {
    if (error.status() != ExitStatus::unreadable) throw;
    result.left_out = error.what();
    result.conditions.clear();
  }
  return result;
}

const Look& Evaluator::look(const Frame& frame, std::size_t condition) {
  const Way& way = ways_.at(condition);
  StageTimes unused;
  way.model->compute(frame, {}, look_.maps, unused);
  way.selector->select(look_.maps.master, frame.depth_mm, frame.intrinsics, look_.attention);
  return look_;
}

}  // namespace saccade
