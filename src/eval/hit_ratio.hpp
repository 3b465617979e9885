#pragma once

#include <map>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// The functions below take `hits`: the label under each attention point, in the order of the points. A label
/// above 0 is an object, 0 is none (structure such as a wall or a table), kVoid is a pixel that nobody
/// labelled. Points beyond the end of `hits` are missing; they hit nothing.
inline constexpr int kVoid = -1;

/// Label -> number of its pixels, without label 0, which is no object.
std::map<int, int> object_areas(const cv::Mat1w& labels);

/// The number of different objects that the first n points hit, n = 1..points.
std::vector<int> objects_found(std::span<const int> hits, int points);

/// HR_n = objects_found[n-1] / n of one image, n = 1..points, Eq. (16).
std::vector<double> hit_ratio(std::span<const int> hits, int points);

/// `hits` without the points on void: the next points take their place. The Hit Ratio of the result is the
/// void-neutral one.
std::vector<int> without_void(std::span<const int> hits);

/// How many points lie on what. The five numbers add up to the number of points.
struct PointKinds {
  int new_object = 0;   ///< on an object that no earlier point hit
  int same_object = 0;  ///< on an object that an earlier point hit
  int structure = 0;    ///< on no object
  int unlabelled = 0;   ///< on void
  int missing = 0;      ///< not there, since the selector ended early

  friend bool operator==(const PointKinds&, const PointKinds&) = default;
};

/// The kinds of the first n points, n = 1..points.
std::vector<PointKinds> point_kinds(std::span<const int> hits, int points);

/// The highest Hit Ratio that any selector can have: min(n, objects)/n, n = 1..points.
std::vector<double> hit_ratio_bound(int objects, int points);

/// The expected HR_n of points drawn independently and uniformly from all pixels: n points hit an object that
/// covers the share p of the image with probability 1 - (1-p)^n.
std::vector<double> random_hit_ratio(const cv::Mat1w& labels, int points);

/// The expected HR_n of points drawn independently from a normal distribution about the middle of the image,
/// truncated at its border, with a quarter of its width and height as standard deviations.
std::vector<double> centre_hit_ratio(const cv::Mat1w& labels, int points);

}  // namespace saccade
