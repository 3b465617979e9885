#pragma once

#include <cstddef>
#include <vector>

#include "eval/bootstrap.hpp"
#include "eval/evaluator.hpp"
#include "eval/plan.hpp"

namespace saccade {

inline constexpr int kResamples = 2000;
inline constexpr std::uint64_t kBootstrapSeed = 1;

/// HR_n averaged over images, n = 1..points, with its 95 % interval.
struct Curve {
  std::vector<double> mean;
  std::vector<Interval> interval;
};

/// HR_n of condition `a` minus that of condition `b` on the same images, at shown_counts().
struct Difference {
  std::size_t a = 0, b = 0;  ///< indices of EvalPlan::conditions(); they differ in one of the three
  std::vector<double> mean;
  std::vector<Interval> interval;  ///< 0 outside of it: the difference is not chance
};

struct Statistics {
  std::size_t images = 0;           ///< that are part of the evaluation
  std::size_t without_objects = 0;  ///< of these: HR and bound are 0
  double objects_mean = 0;
  int objects_least = 0, objects_most = 0;
  Curve bound, random, centre;
  std::vector<Curve> conditions;
  std::vector<double> points_mean;        ///< of each condition: points that its selector gave
  std::vector<double> map_ms, select_ms;  ///< of each condition: mean time
  std::vector<Difference> differences;
};

/// The n that tables show: 1, 2, 3, 5, 10, 20, 30 as far as they go, and the last.
std::vector<int> shown_counts(int points);

/// HR_n of every evaluated image under a condition: rows images, columns n.
Table hit_ratios(const EvalPlan& plan, const std::vector<ImageResult>& images, std::size_t condition);

/// Depends on the images' results and their order only. Throws std::invalid_argument if none was evaluated.
Statistics summarise(const EvalPlan& plan, const std::vector<ImageResult>& images);

}  // namespace saccade
