#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "eval/evaluator.hpp"

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

/// The Reliability of one condition, image by image.
class ReliabilityBuilder {
 public:
  /// The points that the condition chose in one image, `points` of them at most.
  void add(const ConditionResult& result, int points);

  /// Of all images so far; none if their points have no confidence.
  [[nodiscard]] std::optional<Reliability> result() const;

 private:
  Reliability sums_;  // in place of means and shares
  std::size_t objects_ = 0, surely_found_ = 0;
};

}  // namespace saccade
