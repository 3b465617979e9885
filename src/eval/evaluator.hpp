#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "core/worker_pool.hpp"
#include "eval/plan.hpp"
#include "models/model.hpp"

namespace saccade {

/// An attention point and the label there.
struct EvalPoint {
  int row = 0, col = 0;               ///< pixel
  int label = 0;                      ///< of the object that it hits; 0 = none, kVoid (hit_ratio.hpp) = void
  std::optional<float> confidence{};  ///< Fixation::confidence
};

/// The points that one condition chose in one image, in their order. There are kVoidReserve times as many as
/// EvalPlan::points where void is known, since some of them may not count; fewer if the selector ended early.
struct ConditionResult {
  std::vector<EvalPoint> points;
  double map_ms = 0, select_ms = 0;

  /// The labels of the points.
  std::vector<int> hits() const;
};

inline constexpr int kVoidReserve = 3;

/// The result of one image; one line of results.jsonl.
struct ImageResult {
  std::int64_t frame = 0;                 ///< index in the source
  std::string name{};                     ///< of the frame; may be empty
  std::optional<std::string> left_out{};  ///< why the image is not part of the evaluation; none: it is
  int objects = 0;
  bool void_known = false;                    ///< the image has classes, which separate void from structure
  std::vector<double> random{}, centre{};     ///< expected HR_n of the baselines, n = 1..points
  std::vector<ConditionResult> conditions{};  ///< as EvalPlan::conditions()
};

/// A saliency map and the points chosen in it.
struct MapAndPoints {
  SaliencyMaps maps;
  Attention attention;
};

/// Applies the conditions of a plan to images. Keeps memory between frames.
/// Thread safety: one call at a time per object.
class Evaluator {
 public:
  /// `plan` and `pool` must outlive it. Throws Error (usage) if this machine cannot run a model.
  Evaluator(const EvalPlan& plan, WorkerPool& pool);

  /// The frame's result; its map is computed once for all selectors. A frame that has no labels, or that a
  /// model finds unreadable, is left out with the reason. Throws Error if a model fails otherwise.
  ImageResult evaluate(const Frame& frame);

  /// The map and points of one condition; `condition` indexes EvalPlan::conditions().
  const MapAndPoints& compute(const Frame& frame, std::size_t condition);

 private:
  struct Method {
    Condition condition;
    std::shared_ptr<SaliencyModel> model;                // shared by the selectors of one model and kernel
    std::unique_ptr<AttentionSelector> selector;         // chooses EvalPlan::points
    std::unique_ptr<AttentionSelector> larger_selector;  // chooses kVoidReserve times as many
  };
  ConditionResult measure(const Frame& frame, std::size_t condition);

  std::vector<Method> methods_;
  int points_;
  MapAndPoints current_;
  double map_ms_ = 0;  // of the map in current_
};

}  // namespace saccade
