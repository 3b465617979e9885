#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "core/settings.hpp"

namespace saccade {

/// What the operator needs to know besides the depth image and the camera.
struct Symmetry3dParams {
  int kernel = 15;                      ///< k, px at every level; 3..127; window side 2*floor(k/2)+1
  int first_level = 0, last_level = 4;  ///< L1..L2 of Eq. (15)
  LengthScale length_scale = LengthScale::relative;
  LevelNormalisation normalisation = LevelNormalisation::none;

  static Symmetry3dParams from(const Settings& settings);

  int reach() const { return kernel / 2; }  ///< h, px: the window is (2h+1)^2 pixels
  /// lambda in pixels of a level at the depth of the window's centre, so that lambda = lambda_px() * z/fx: 5
  /// % of the window's width. None: lambda is 1 mm.
  std::optional<double> lambda_px() const;
};

/// Size of pyramid level `level` of an image: level l+1 holds the even rows and columns of level l.
cv::Size level_size(cv::Size image, int level);

/// The deepest level of an image that has at least 8 px a side; -1 if the image itself has not.
int deepest_level(cv::Size image);

/// The last level that settings mean for an image: levels that the user chose stay, check_levels() refuses
/// them if they do not fit; the default ones are cut to those that the image has room for. An image without
/// room for any leaves it as it is.
int last_level_for(const Settings& settings, cv::Size image);

/// Throws Error (usage) if the last level would have a side below 8 px, naming the deepest that fits; Error
/// (unreadable) if the image itself is too small.
void check_levels(cv::Size image, const Symmetry3dParams& params);

}  // namespace saccade
