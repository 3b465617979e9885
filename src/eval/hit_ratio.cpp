#include "eval/hit_ratio.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace saccade {
namespace {

// HR_n for points drawn independently, given the probability of each object to be hit by one.
std::vector<double> expected_hit_ratio(const std::map<int, double>& probability, int points) {
  std::vector<double> ratio;
  for (int n = 1; n <= points; ++n) {
    double found = 0;
    for (const auto& [label, p] : probability) found += 1 - std::pow(1 - p, n);
    ratio.push_back(found / n);
  }
  return ratio;
}

// exp(-x^2/2) of each pixel of a side, x its distance from the middle in quarters of the side.
std::vector<double> centre_weights(int side) {
  std::vector<double> weights;
  for (int i = 0; i < side; ++i) {
    const double x = (i - (side - 1) / 2.0) / (side / 4.0);
    weights.push_back(std::exp(-x * x / 2));
  }
  return weights;
}

}  // namespace

std::map<int, int> object_areas(const cv::Mat1w& labels) {
  std::map<int, int> areas;
  for (int r = 0; r < labels.rows; ++r)
    for (int c = 0; c < labels.cols; ++c)
      if (labels(r, c) != 0) ++areas[labels(r, c)];
  return areas;
}

std::vector<int> objects_found(std::span<const int> hits, int points) {
  std::set<int> found;
  std::vector<int> counts;
  for (std::size_t n = 0; n < static_cast<std::size_t>(points); ++n) {
    if (n < hits.size() && hits[n] > 0) found.insert(hits[n]);
    counts.push_back(static_cast<int>(found.size()));
  }
  return counts;
}

std::vector<double> hit_ratio(std::span<const int> hits, int points) {
  std::vector<double> ratio;
  for (const int found : objects_found(hits, points))
    ratio.push_back(found / static_cast<double>(ratio.size() + 1));  // Eq. (16)
  return ratio;
}

std::vector<int> without_void(std::span<const int> hits) {
  std::vector<int> kept;
  std::copy_if(hits.begin(), hits.end(), std::back_inserter(kept), [](int label) { return label != kVoid; });
  return kept;
}

std::vector<PointKinds> point_kinds(std::span<const int> hits, int points) {
  std::set<int> seen;
  PointKinds kinds;
  std::vector<PointKinds> all;
  for (std::size_t n = 0; n < static_cast<std::size_t>(points); ++n) {
    if (n >= hits.size())
      ++kinds.missing;
    else if (hits[n] == kVoid)
      ++kinds.unlabelled;
    else if (hits[n] == 0)
      ++kinds.structure;
    else
      ++(seen.insert(hits[n]).second ? kinds.new_object : kinds.same_object);
    all.push_back(kinds);
  }
  return all;
}

std::vector<double> hit_ratio_bound(int objects, int points) {
  std::vector<double> bound;
  for (int n = 1; n <= points; ++n) bound.push_back(std::min(n, objects) / static_cast<double>(n));
  return bound;
}

std::vector<double> random_hit_ratio(const cv::Mat1w& labels, int points) {
  std::map<int, double> probability;
  for (const auto& [label, area] : object_areas(labels))
    probability[label] = area / static_cast<double>(labels.total());
  return expected_hit_ratio(probability, points);
}

std::vector<double> centre_hit_ratio(const cv::Mat1w& labels, int points) {
  const auto of_row = centre_weights(labels.rows), of_col = centre_weights(labels.cols);
  std::map<int, double> weight;
  double total = 0;
  for (int r = 0; r < labels.rows; ++r)
    for (int c = 0; c < labels.cols; ++c) {
      const double w = of_row[static_cast<std::size_t>(r)] * of_col[static_cast<std::size_t>(c)];
      total += w;
      if (labels(r, c) != 0) weight[labels(r, c)] += w;
    }
  for (auto& [label, w] : weight) w = std::min(w / total, 1.0);
  return expected_hit_ratio(weight, points);
}

}  // namespace saccade
