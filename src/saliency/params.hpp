#pragma once

#include <optional>

#include <opencv2/core.hpp>

namespace saccade {

/// lambda, the unit of Delta D and Delta d in Eq. (3): section 2.4.
enum class LengthScale {
  relative,    ///< 5 % of the window's width at the depth of the pixel
  millimetre,  ///< 1 mm, as in the authors' experiments
};
/// The factor of a level's map in the master map: section 3.
enum class LevelNormalisation { none, max, itti };

/// The operator's parameters. Sections: those of README.md in this folder.
struct Symmetry3dParams {
  int kernel = 15;                      ///< k, px at every level; 3..127; window side 2*floor(k/2)+1
  int first_level = 0, last_level = 4;  ///< L1..L2 of Eq. (15)
  LengthScale length_scale = LengthScale::relative;
  LevelNormalisation normalisation = LevelNormalisation::none;

  /// h, px: the window is (2h+1)^2 pixels.
  int reach() const { return kernel / 2; }
  /// lambda in pixels of a level at the depth z of the window's centre, 5 % of k: lambda = lambda_px() *
  /// z/fx. None: lambda is 1 mm.
  std::optional<double> lambda_px() const;
};

/// Size of pyramid level `level` of an image: level l+1 holds the even rows and columns of level l.
cv::Size level_size(cv::Size image, int level);

/// The deepest level of an image that has at least 8 px a side; -1 if the image itself is smaller.
int deepest_level(cv::Size image);

/// Throws Error (usage) if the last level has a side below 8 px, naming the deepest that fits; Error
/// (unreadable) if the image itself is too small.
void check_levels(cv::Size image, const Symmetry3dParams& params);

}  // namespace saccade
