#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/bootstrap.hpp"
#include "eval/evaluator.hpp"
#include "eval/plan.hpp"
#include "eval/reliability.hpp"
#include "eval/sample.hpp"

namespace saccade {

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

/// An image that is not part of the evaluation.
struct LeftOut {
  std::int64_t frame = 0;
  std::string name, reason;
};

inline constexpr std::size_t kMostNamed = 1000;

struct Statistics {
  std::size_t images = 0;  ///< part of the evaluation
  std::size_t images_left_out = 0;
  std::vector<LeftOut> left_out;    ///< of these, the first kMostNamed
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

/// Mean of HR_n / bound_n of an image with objects over n = 1..10, as far as EvalPlan::points allows.
double share_of_bound(const EvalPlan& plan, const ImageResult& image, std::size_t condition);

/// Statistics of images that come one by one. The memory that it needs does not grow with their number beyond
/// kMostResampled.
class StatisticsBuilder {
 public:
  explicit StatisticsBuilder(const EvalPlan& plan);

  /// In the order of the images, on which the result depends.
  void add(const ImageResult& image);

  /// Of all images so far. Throws std::invalid_argument if none of them is part of the evaluation.
  [[nodiscard]] Statistics result() const;

 private:
  struct OfCondition {
    Sample hit_ratio, void_neutral;
    std::vector<PointShares> points_on;  // sums
    ReliabilityBuilder reliability;
    std::array<double, 2> share_of_bound{};        // sums over the even and the odd images
    double points = 0, map_ms = 0, select_ms = 0;  // sums
  };
  struct Pair {  // of conditions that differ in one of the three
    std::size_t a = 0, b = 0;
    Moments difference;  // at shown_counts()
  };

  void count(const ImageResult& image);
  void add_condition(const ImageResult& image, std::size_t condition);
  void add_differences();
  Difference difference_of(const Pair& pair, const std::vector<Table>& samples) const;
  std::size_t best_on_half(const std::string& model, std::size_t half) const;
  CrossValidation cross_validate(const std::string& model) const;

  EvalPlan plan_;
  std::vector<Condition> conditions_;
  std::vector<int> counts_;
  Statistics counted_;  // images and objects
  Sample bound_, random_, centre_;
  std::vector<OfCondition> of_condition_;
  std::vector<std::vector<double>> rows_;  // of the present image, by condition
  std::vector<Pair> pairs_;
};

}  // namespace saccade
