#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "saliency/params.hpp"

/// The operator that README.md in this folder describes, in double and one pixel at a time: slow, and written
/// to be read. Symmetry3d is the fast form; tests compare the two. Equation numbers are those of the paper
/// (Potapova, Zillich, Vincze, "Local 3D Symmetry for Visual Saliency in 2.5D Point Clouds"), sections those
/// of README.md.
namespace saccade::reference {

/// One level of the pyramid. A pixel is valid in the operator if it has a depth and a normal.
struct Level {
  cv::Mat1d depth_mm;   ///< h x w, 0 = no reading
  cv::Mat3d points_mm;  ///< h x w, camera frame; (0,0,0) = no reading
  cv::Mat3d normals;    ///< h x w, unit, towards the camera; (0,0,0) = none
  Intrinsics camera;    ///< of this level
};

/// Section 1.2, the next level: depth in mm, 0 = no reading, h x w to (h+1)/2 x (w+1)/2, in steps of 1/8 mm.
cv::Mat1d halve(const cv::Mat1d& depth_mm);

/// Sections 1.1 and 1.3, points and normals of one level: `depth_mm` h x w, 0 = no reading.
Level make_level(const cv::Mat1d& depth_mm, const Intrinsics& camera_of_level);

/// What decided the score of a plane.
enum class PlaneVerdict {
  half_empty,    ///< no point on one side
  no_direction,  ///< mean points coincide or a mean normal vanishes: l, n' or n'' is undefined
  not_convex,    ///< the gate of Eq. (14) is shut
  flat,          ///< the mean normals of the halves are parallel: N of Eq. (8) is undefined
  scores,
};

/// One candidate plane at one pixel. All numbers are 0 for the verdicts half_empty and no_direction.
struct PlaneSymmetry {
  Eigen::Vector3d gamma;  ///< the plane's unit normal
  PlaneVerdict verdict = PlaneVerdict::half_empty;
  double score = 0;             ///< exp(-(Delta D + Delta d)/lambda) * omega_1 * omega_2, or 0; 0..4
  double delta_D_mm = 0;        ///< Eq. (4)
  double delta_d_mm = 0;        ///< Eq. (7)
  double omega_1 = 0;           ///< Eq. (8), 0..1
  double omega_2 = 0;           ///< Eq. (12), 0..4
  double cos_1 = 0, cos_2 = 0;  ///< n'.l and n''.l; the gate of Eq. (14) is open if cos_1 > 0 > cos_2
};

/// The three planes of one pixel and the eigenvalues of its normals' covariance, ascending.
struct PixelSymmetry {
  std::array<PlaneSymmetry, 3> planes;
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();

  double score() const;  ///< s(r,c), the best plane's: 0..4
};

/// Section 2, the operator at pixel (row, col); std::nullopt where the pixel is not valid.
std::optional<PixelSymmetry> symmetry_at(const Level& level, int row, int col,
                                         const Symmetry3dParams& params);

/// The operator at every pixel of one level: h x w, 0..4; 0 where a pixel is not valid.
cv::Mat1d symmetry_map(const Level& level, const Symmetry3dParams& params);

/// The factor of a level's map in the master map, section 3; 1 for a map that is 0 everywhere.
double level_weight(const cv::Mat1d& map, LevelNormalisation kind);

/// Section 3, Eq. (15): the sum of the normalised maps at size `full`; maps[i] is that of first_level + i.
cv::Mat1d master_map(const std::vector<cv::Mat1d>& maps, int first_level, cv::Size full,
                     LevelNormalisation kind);

struct Result {
  cv::Mat1d master;               ///< H x W
  std::vector<cv::Mat1d> levels;  ///< maps of first_level..last_level, each at its own size, not normalised
};

/// The whole operator. `depth_mm`: H x W; 0 = no reading, else finite and above 0. Throws as check_levels().
Result symmetry3d(const cv::Mat1f& depth_mm, const Intrinsics& camera, const Symmetry3dParams& params);

}  // namespace saccade::reference
