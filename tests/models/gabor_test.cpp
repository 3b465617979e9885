#include "models/gabor.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

namespace saccade {
namespace {

// Direct: the sum over the window of exp(i (kx x + ky y)) times the Gaussian, and for the even part without
// the response to a constant.
double energy_at(const cv::Mat1f& image, int orientation, int row, int col) {
  const double angle = orientation * std::numbers::pi / 4, k = 2 * std::numbers::pi / 7, sigma = 7.0 / 3;
  std::complex<double> sum, of_ones;
  double smooth = 0, total = 0;
  for (int y = -7; y <= 7; ++y)
    for (int x = -7; x <= 7; ++x) {
      const double gauss = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
      const auto wave = gauss * std::polar(1.0, k * (std::cos(angle) * x + std::sin(angle) * y));
      const double value = image(row + y, col + x);
      sum += wave * value;
      of_ones += wave;
      smooth += gauss * value;
      total += gauss;
    }
  return std::abs(sum / total - of_ones.real() / total * smooth / total);
}

TEST(GaborFilters, EqualTheirDefinition) {
  cv::Mat1f image(40, 50);
  cv::theRNG().state = 3;
  cv::randu(image, 0, 1);
  const GaborFilters filters;
  GaborFilters::Parts parts;
  for (int part = 0; part < GaborFilters::kParts; ++part)
    filters.find_part(image, static_cast<GaborFilters::Part>(part), parts);
  std::array<cv::Mat1f, 2> scratch;
  cv::Mat1f energy;
  for (int orientation = 0; orientation < GaborFilters::kOrientations; ++orientation) {
    filters.find_energy(orientation, parts, scratch, energy);
    for (int row = 7; row < 33; row += 5)
      for (int col = 7; col < 43; col += 5)
        EXPECT_NEAR(static_cast<double>(energy(row, col)), energy_at(image, orientation, row, col), 1e-6)
            << orientation << " at " << row << ", " << col;
  }
}

TEST(GaborFilters, FindTheirOwnGrating) {
  for (int orientation = 0; orientation < GaborFilters::kOrientations; ++orientation) {
    const double angle = orientation * std::numbers::pi / 4, k = 2 * std::numbers::pi / 7;
    cv::Mat1f grating(60, 60);
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 60; ++x)
        grating(y, x) = static_cast<float>(std::cos(k * (std::cos(angle) * x + std::sin(angle) * y)));
    const GaborFilters filters;
    GaborFilters::Parts parts;
    for (int part = 0; part < GaborFilters::kParts; ++part)
      filters.find_part(grating, static_cast<GaborFilters::Part>(part), parts);
    std::array<cv::Mat1f, 2> scratch;
    for (int other = 0; other < GaborFilters::kOrientations; ++other) {
      cv::Mat1f energy;
      filters.find_energy(other, parts, scratch, energy);
      const double seen = static_cast<double>(energy(30, 30));
      if (other == orientation)
        EXPECT_NEAR(seen, 0.5, 0.03) << orientation;
      else
        EXPECT_LT(seen, 0.15) << orientation << " seen by " << other;
    }
  }
}

}  // namespace
}  // namespace saccade
