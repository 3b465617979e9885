#pragma once

#include <array>

#include <opencv2/core.hpp>

namespace saccade {

/// Pairs of Gabor filters in 4 orientations: exp(i (kx x + ky y)) times a Gaussian, with a period of 7 px and
/// sigma = period/3, 15 x 15. Each is a sum of products of a function of x and one of y,
///   cos(a + b) = cos a cos b - sin a sin b,   sin(a + b) = sin a cos b + cos a sin b,
/// and the orientations share the functions of x: 0 and 90 degrees need cos and sin of one frequency and the
/// Gaussian alone, the diagonals those of another. Thread safety: all functions are const.
class GaborFilters {
 public:
  static constexpr int kOrientations = 4;  ///< orientation o is at o * 45 degrees

  /// What the orientations share, by what the rows of the image are filtered with; kSmooth is the image
  /// smoothed in both directions.
  enum Part { kGauss, kCosine, kSine, kDiagonalCosine, kDiagonalSine, kSmooth, kParts };
  using Parts = std::array<cv::Mat1f, kParts>;

  GaborFilters();

  /// Computes one part for an image. Different parts at the same time are allowed.
  void find_part(const cv::Mat1f& image, Part part, Parts& parts) const;

  /// The magnitude of the response to the pair of an orientation, without that to the mean brightness.
  /// `scratch` keeps its memory.
  void find_energy(int orientation, const Parts& parts, std::array<cv::Mat1f, 2>& scratch,
                   cv::Mat1f& energy) const;

 private:
  std::array<cv::Mat1f, kSmooth> kernels_;       ///< by part, 1 x 15
  double constant_ = 0, diagonal_constant_ = 0;  ///< responses of the even filters to an image of ones
};

}  // namespace saccade
