#pragma once

#include <map>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

namespace saccade {

/// Label -> number of its pixels, without label 0, which is no object.
std::map<int, int> object_areas(const cv::Mat1w& labels);

/// Of each n = 1..points the number of different objects that the first n points hit. `hits` holds the label
/// under each point in its order, 0 = none; points that are missing hit nothing.
std::vector<int> objects_found(std::span<const int> hits, int points);

/// HR_n = objects_found[n-1] / n of one image, n = 1..points, Eq. (16).
std::vector<double> hit_ratio(std::span<const int> hits, int points);

/// What no selector can pass: min(n, objects)/n, n = 1..points.
std::vector<double> hit_ratio_bound(int objects, int points);

/// The expected HR_n of points drawn independently and uniformly from all pixels. It is computed, not drawn:
/// an object of share p of the image is among n points with probability 1 - (1-p)^n.
std::vector<double> random_hit_ratio(const cv::Mat1w& labels, int points);

/// The expected HR_n of points drawn independently from a normal distribution about the middle of the image,
/// cut at its border, with a quarter of its width and height as standard deviations.
std::vector<double> centre_hit_ratio(const cv::Mat1w& labels, int points);

}  // namespace saccade
