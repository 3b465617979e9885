#include "models/gabor.hpp"

#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

constexpr int kReach = 7;  // 3 sigma

// The kernel of a direction that is not filtered.
cv::Mat1f no_filter() { return cv::Mat1f(1, 1, 1.0F); }

void filter_columns(const cv::Mat1f& image, const cv::Mat1f& kernel, cv::Mat1f& out) {
  cv::sepFilter2D(image, out, CV_32F, no_filter(), kernel);
}

}  // namespace

GaborFilters::GaborFilters() {
  constexpr double kPeriod = 7, kSigma = kPeriod / 3, kFrequency = 2 * std::numbers::pi / kPeriod;
  constexpr double kDiagonal = kFrequency / std::numbers::sqrt2;  // along x, and along y
  for (cv::Mat1f& kernel : kernels_) kernel.create(1, 2 * kReach + 1);
  double sum = 0;
  for (int i = -kReach; i <= kReach; ++i) sum += std::exp(-i * i / (2 * kSigma * kSigma));
  for (int i = -kReach; i <= kReach; ++i) {
    const double gauss = std::exp(-i * i / (2 * kSigma * kSigma)) / sum;
    kernels_[kGauss](i + kReach) = static_cast<float>(gauss);
    kernels_[kCosine](i + kReach) = static_cast<float>(gauss * std::cos(kFrequency * i));
    kernels_[kSine](i + kReach) = static_cast<float>(gauss * std::sin(kFrequency * i));
    kernels_[kDiagonalCosine](i + kReach) = static_cast<float>(gauss * std::cos(kDiagonal * i));
    kernels_[kDiagonalSine](i + kReach) = static_cast<float>(gauss * std::sin(kDiagonal * i));
  }
  // The sums of the sines are 0.
  constant_ = cv::sum(kernels_[kCosine])[0] * cv::sum(kernels_[kGauss])[0];
  diagonal_constant_ = std::pow(cv::sum(kernels_[kDiagonalCosine])[0], 2);
}

void GaborFilters::find_part(const cv::Mat1f& image, Part part, Parts& parts) const {
  const cv::Mat1f& gauss = kernels_[kGauss];
  if (part == kSmooth)
    cv::sepFilter2D(image, parts[kSmooth], CV_32F, gauss, gauss);
  else
    cv::sepFilter2D(image, parts[part], CV_32F, kernels_[part], no_filter());
}

void GaborFilters::find_energy(int orientation, const Parts& parts, std::array<cv::Mat1f, 2>& scratch,
                               cv::Mat1f& energy) const {
  auto& [even, odd] = scratch;
  const bool is_diagonal = orientation % 2 == 1;
  if (orientation == 0) {
    filter_columns(parts[kCosine], kernels_[kGauss], even);
    filter_columns(parts[kSine], kernels_[kGauss], odd);
  } else if (orientation == 2) {
    filter_columns(parts[kGauss], kernels_[kCosine], even);
    filter_columns(parts[kGauss], kernels_[kSine], odd);
  } else {
    const double sign = orientation == 1 ? 1 : -1;  // of the sine along x
    filter_columns(parts[kDiagonalCosine], kernels_[kDiagonalCosine], even);
    filter_columns(parts[kDiagonalSine], kernels_[kDiagonalSine], energy);
    cv::scaleAdd(energy, -sign, even, even);
    filter_columns(parts[kDiagonalCosine], kernels_[kDiagonalSine], odd);
    filter_columns(parts[kDiagonalSine], kernels_[kDiagonalCosine], energy);
    cv::scaleAdd(energy, sign, odd, odd);
  }
  cv::scaleAdd(parts[kSmooth], is_diagonal ? -diagonal_constant_ : -constant_, even, even);
  cv::magnitude(even, odd, energy);
}

}  // namespace saccade
