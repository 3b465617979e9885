// radial2d against the transform as the article writes it, in double.

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "displays.hpp"

namespace saccade {
namespace {

// The convolution of F with a Gaussian of sigma = n/4, cut at 3 sigma.
cv::Mat1d blur(const cv::Mat1d& f, int n) {
  const double sigma = 0.25 * n;
  const int reach = static_cast<int>(std::ceil(3 * sigma));
  double total = 0;
  for (int v = -reach; v <= reach; ++v)
    for (int u = -reach; u <= reach; ++u) total += std::exp(-(v * v + u * u) / (2 * sigma * sigma));
  cv::Mat1d out(f.size(), 0.0);
  for (int r = 0; r < f.rows; ++r)
    for (int c = 0; c < f.cols; ++c)
      for (int v = -reach; v <= reach; ++v)
        for (int u = -reach; u <= reach; ++u)
          if (r + v >= 0 && c + u >= 0 && r + v < f.rows && c + u < f.cols)
            out(r, c) += f(r + v, c + u) * std::exp(-(v * v + u * u) / (2 * sigma * sigma)) / total;
  return out;
}

cv::Mat1d reference(const cv::Mat1b& grey) {
  cv::Mat1d gx, gy, sum(grey.size(), 0.0);
  cv::Sobel(grey, gx, CV_64F, 1, 0);
  cv::Sobel(grey, gy, CV_64F, 0, 1);
  for (const int n : {1, 3, 5}) {
    cv::Mat1d o(grey.size(), 0.0), m(grey.size(), 0.0), f(grey.size());
    const cv::Rect image({0, 0}, grey.size());
    for (int r = 0; r < grey.rows; ++r)
      for (int c = 0; c < grey.cols; ++c) {
        const double length = std::hypot(gx(r, c), gy(r, c));
        if (length == 0) continue;
        const cv::Point step(static_cast<int>(std::lround(gx(r, c) / length * n)),
                             static_cast<int>(std::lround(gy(r, c) / length * n)));
        for (const int sign : {1, -1}) {
          const cv::Point at = cv::Point(c, r) + sign * step;
          if (!image.contains(at)) continue;
          o(at) += sign;
          m(at) += sign * length / 255;
        }
      }
    const double k = n == 1 ? 8 : 9.9;
    for (int r = 0; r < grey.rows; ++r)
      for (int c = 0; c < grey.cols; ++c)
        f(r, c) = m(r, c) / k * std::pow(std::min(std::abs(o(r, c)), k) / k, 2);
    sum += blur(f, n) / 3;
  }
  for (double& value : sum) value = std::abs(value);
  return sum;
}

TEST(Radial2d, IsTheTransformOfTheArticle) {
  for (const cv::Size size : {cv::Size(64, 48), cv::Size(37, 51), cv::Size(7, 5)}) {
    const cv::Mat3b image = noise_image(size);
    cv::Mat1b grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    const cv::Mat1d expected = reference(grey);
    EXPECT_LT(cv::norm(as_double(map_of("radial2d", frame_of(image))), expected, cv::NORM_INF),
              1e-5 * cv::norm(expected, cv::NORM_INF) + 1e-7);
  }
}

TEST(Radial2d, IsHighestInTheMiddleOfDiscsBrightAndDark) {
  for (const int shade : {255, 0}) {
    cv::Mat3b image(60, 80, cv::Vec3b(128, 128, 128));
    cv::circle(image, {50, 25}, 4, cv::Scalar::all(shade), cv::FILLED, cv::LINE_AA);
    const cv::Point at = maximum_of(map_of("radial2d", frame_of(image)));
    EXPECT_LE(std::hypot(at.x - 50, at.y - 25), 1.5) << at;
  }
}

}  // namespace
}  // namespace saccade
