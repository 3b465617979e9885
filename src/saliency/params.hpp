#pragma once

#include <optional>

#include <opencv2/core.hpp>

namespace saccade {

enum class LengthScale {
  relative,    ///< lambda = 5 % of the window's width at the depth of the pixel
  millimetre,  ///< lambda = 1 mm, as in the authors' experiments
};
enum class LevelNormalisation { none, max, itti };

/// What the operator needs to know besides the depth image and the camera.
struct Symmetry3dParams {
  int kernel = 15;                      ///< k, px at every level; 3..127; window side 2*floor(k/2)+1
  int first_level = 0, last_level = 4;  ///< L1..L2 of Eq. (15)
  LengthScale length_scale = LengthScale::relative;             ///< unit of Delta D and Delta d in Eqs. (3)
  LevelNormalisation normalisation = LevelNormalisation::none;  ///< of each level's map before they are added

  int reach() const { return kernel / 2; }  ///< h, px: the window is (2h+1)^2 pixels
  /// lambda in pixels of a level at the depth of the window's centre, so that lambda = lambda_px() * z/fx: 5
  /// % of the window's width. None: lambda is 1 mm.
  std::optional<double> lambda_px() const;
};

/// Size of pyramid level `level` of an image: level l+1 holds the even rows and columns of level l.
cv::Size level_size(cv::Size image, int level);

/// The deepest level of an image that has at least 8 px a side; -1 if the image itself has not.
int deepest_level(cv::Size image);

/// Throws Error (usage) if the last level would have a side below 8 px, naming the deepest that fits; Error
/// (unreadable) if the image itself is too small.
void check_levels(cv::Size image, const Symmetry3dParams& params);

}  // namespace saccade
