#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "eval/evaluator.hpp"
#include "eval/plan.hpp"

namespace saccade {

/// How the confidence of points compares with what they lie on: of the first EvalPlan::points points of each
/// image. Points on void are left out, since nobody knows what they lie on.
struct Reliability {
  static constexpr std::size_t kBins = 10;
  struct Bin {
    std::size_t points = 0;
    double confidence = 0;  ///< mean; 0 without points
    double on_object = 0;   ///< share of the points; 0 without points
  };
  std::array<Bin, kBins> bins;  ///< of width 1/kBins; the last one includes 1
  std::size_t points = 0;
  double brier = 0;  ///< mean of (confidence - 1)^2 on objects and confidence^2 elsewhere

  // Of the points with a confidence of at least kProbablyObject:
  std::size_t sure = 0;
  double precision = 0;  ///< share that lies on objects; 0 without points
  double recall = 0;     ///< share of the objects that any point hit; 0 without objects
};

/// None if the points of this condition have no confidence. `condition` indexes EvalPlan::conditions().
std::optional<Reliability> reliability_of(const EvalPlan& plan, const std::vector<ImageResult>& images,
                                          std::size_t condition);

}  // namespace saccade
