#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "core/worker_pool.hpp"
#include "eval/plan.hpp"
#include "models/model.hpp"

namespace saccade {

/// An attention point and what is there.
struct EvalPoint {
  int row = 0, col = 0;
  int label = 0;  ///< of the object that it hits; 0 = none
};

/// What one condition did on one image.
struct ConditionResult {
  std::vector<EvalPoint> points;  ///< in their order; fewer than were asked for if the selector ended early
  double map_ms = 0, select_ms = 0;
};

/// What became of one image; one line of results.jsonl.
struct ImageResult {
  std::int64_t frame = 0;  ///< index in the source
  std::string name;        ///< of the frame; may be empty
  std::string left_out;    ///< why the image is not part of the evaluation; empty = it is
  int objects = 0;
  std::vector<double> random, centre;       ///< expected HR_n of the baselines, n = 1..points
  std::vector<ConditionResult> conditions;  ///< as EvalPlan::conditions()
};

/// A saliency map and the points chosen in it.
struct Look {
  SaliencyMaps maps;
  Attention attention;
};

/// Applies the conditions of a plan to images. Keeps memory between frames.
/// Thread safety: one call at a time per object.
class Evaluator {
 public:
  /// `plan` and `pool` must outlive it. Throws Error (usage) if this machine cannot run a model.
  Evaluator(const EvalPlan& plan, WorkerPool& pool);

  /// The frame's result; its map is computed once for all selectors. A frame without labels, or that a model
  /// finds unreadable, is left out and says why. Throws Error if a model fails otherwise.
  ImageResult evaluate(const Frame& frame);

  /// The map and points of one condition; `condition` indexes EvalPlan::conditions().
  const Look& look(const Frame& frame, std::size_t condition);

 private:
  struct Way {
    Condition condition;
    std::shared_ptr<SaliencyModel> model;  // shared by the selectors of one model and kernel
    std::unique_ptr<AttentionSelector> selector;
  };
  ConditionResult measure(const Frame& frame, std::size_t condition);

  std::vector<Way> ways_;
  int points_;
  Look look_;
  double map_ms_ = 0;  // of the map that look_ holds
};

}  // namespace saccade
