#include "ui/session/map_difference.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace saccade {

MapDifference map_difference(const cv::Mat1f& a, const cv::Mat1f& b) {
  if (a.size() != b.size()) throw std::invalid_argument("map_difference: maps of one size expected");
  MapDifference difference;
  cv::subtract(a, b, difference.values);
  double low = 0, high = 0;
  cv::minMaxLoc(difference.values, &low, &high);
  difference.largest = static_cast<float>(std::max(-low, high));
  return difference;
}

cv::Vec3b difference_colour(double share) {
  return share >= 0 ? cv::Vec3b(20, 130, 255) : cv::Vec3b(255, 130, 20);
}

void blend_difference(cv::Mat3b& picture, const MapDifference& difference, double opacity) {
  if (picture.size() != difference.values.size())
    throw std::invalid_argument("blend_difference: picture and difference of one size expected");
  if (!(difference.largest > 0)) return;
  for (int r = 0; r < picture.rows; ++r)
    for (int c = 0; c < picture.cols; ++c) {
      const float share = difference.values(r, c) / difference.largest;
      const float a = static_cast<float>(opacity) * std::sqrt(std::abs(share));
      const cv::Vec3b colour = difference_colour(static_cast<double>(share));
      cv::Vec3b& pixel = picture(r, c);
      for (int i = 0; i < 3; ++i)
        pixel[i] = cv::saturate_cast<std::uint8_t>((1 - a) * static_cast<float>(pixel[i]) +
                                                   a * static_cast<float>(colour[i]));
    }
}

}  // namespace saccade
