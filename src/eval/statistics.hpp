#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "eval/bootstrap.hpp"
#include "eval/evaluator.hpp"
#include "eval/plan.hpp"
#include "eval/reliability.hpp"

namespace saccade {

inline constexpr int kResamples = 2000;
inline constexpr std::uint64_t kBootstrapSeed = 1;

/// HR_n averaged over images, n = 1..points, with its 95 % interval.
struct Curve {
  std::vector<double> mean;
  std::vector<Interval> interval;
};

/// The Hit Ratio of a model whose kernel and selector were chosen on other images than those that are
/// reported: each half of the images (even and odd, counted in their order without those left out) is
/// evaluated under the condition with the highest share_of_bound() on the other half. A choice on all images
/// would report the best of several noisy figures.
struct CrossValidation {
  std::string model;
  std::array<std::size_t, 2> used = {};  ///< condition under which the even and the odd images are evaluated
  Curve curve;
};

/// HR_n of condition `a` minus that of condition `b` on the same images, at shown_counts().
struct Difference {
  std::size_t a = 0, b = 0;  ///< indices of EvalPlan::conditions(); they differ in one of the three
  std::vector<double> mean;
  std::vector<Interval> interval;  ///< if 0 is outside, chance alone does not explain the difference
};

/// The shares of the first n points that lie on what (PointKinds), averaged over images; they add up to 1,
/// and that of new objects is HR_n.
struct PointShares {
  double new_object = 0, same_object = 0, structure = 0, unlabelled = 0, missing = 0;
};

struct Statistics {
  std::size_t images = 0;           ///< part of the evaluation
  std::size_t without_objects = 0;  ///< of these: HR and bound are 0
  std::size_t void_known = 0;       ///< of these: images with classes
  double objects_mean = 0;
  int objects_least = 0, objects_most = 0;
  Curve bound, random, centre;
  std::vector<Curve> conditions;
  std::vector<Curve> void_neutral;                  ///< of each condition; empty if no image has classes
  std::vector<std::vector<PointShares>> points_on;  ///< of each condition, n = 1..points
  std::vector<std::array<std::vector<double>, 2>> halves;  ///< of each condition: HR_n of even and odd images
  std::vector<std::optional<Reliability>> reliability;     ///< of each condition
  std::vector<double> points_mean;  ///< of each condition: points that its selector gave, up to `points`
  std::vector<double> map_ms, select_ms;  ///< of each condition: mean time
  std::vector<Difference> differences;
  std::vector<CrossValidation> cross_validations;
};

/// The n that tables show: those of 1, 2, 3, 5, 10, 20, 30 up to `points`, and `points`.
std::vector<int> shown_counts(int points);

/// HR_n of every evaluated image under a condition: rows images, columns n.
Table hit_ratios(const EvalPlan& plan, const std::vector<ImageResult>& images, std::size_t condition);

/// The same without the points on void. An image without classes has none.
Table void_neutral_hit_ratios(const EvalPlan& plan, const std::vector<ImageResult>& images,
                              std::size_t condition);

/// Mean of HR_n / bound_n of an image with objects over n = 1..10, as far as EvalPlan::points allows.
double share_of_bound(const EvalPlan& plan, const ImageResult& image, std::size_t condition);

/// Depends on the images' results and their order only. Throws std::invalid_argument if no image is part of
/// the evaluation.
Statistics summarise(const EvalPlan& plan, const std::vector<ImageResult>& images);

}  // namespace saccade
