#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "saliency/params.hpp"

/// The operator as the paper says it (Potapova, Zillich, Vincze, "Local 3D Symmetry for Visual Saliency
/// in 2.5D Point Clouds"), in double, one pixel at a time: slow, and made to be read. Symmetry3d is the fast
/// form; tests hold it against this one. Equation numbers are the paper's; departures from its print say so.
namespace saccade::reference {

/// One level of the pyramid. A pixel is valid in the operator if it has a depth and a normal.
struct Level {
  cv::Mat1d depth_mm;   ///< h x w, 0 = no reading
  cv::Mat3d points_mm;  ///< h x w, camera frame; (0,0,0) where there is no reading
  cv::Mat3d normals;    ///< h x w, unit, towards the camera; (0,0,0) = none
  Intrinsics camera;    ///< of this level
};

/// Next level: the even pixels after the validity-aware binomial [1 4 6 4 1]/16, rounded to 1/8 mm
/// (SPEC 1.2).
cv::Mat1d halve(const cv::Mat1d& depth_mm);

/// Points and normals of one level from its depth (SPEC 1.1 and 1.3).
Level make_level(const cv::Mat1d& depth_mm, const Intrinsics& camera_of_level);

/// How far the operator got with a plane before its score was certain.
enum class PlaneVerdict {
  half_empty,    ///< no point on one side
  no_direction,  ///< mean points that coincide or mean normals that vanish: l, n' or n'' is undefined
  not_convex,    ///< the gate of Eq. (14) is shut
  flat,          ///< the halves' mean normals are parallel, N of Eq. (8) is undefined
  scores,
};

/// What one candidate plane says at one pixel; for tests and for explaining a pixel.
struct PlaneSymmetry {
  Eigen::Vector3d gamma;  ///< the plane's unit normal
  PlaneVerdict verdict = PlaneVerdict::half_empty;
  double score = 0;       ///< exp(-(Delta D + Delta d)/lambda) * omega_1 * omega_2, 0 if the gate is shut
  double delta_D_mm = 0;  ///< Eq. (4)
  double delta_d_mm = 0;  ///< Eq. (7)
  double omega_1 = 0;     ///< Eq. (8)
  double omega_2 = 0;     ///< Eq. (12)
  double cos_1 = 0, cos_2 = 0;  ///< n'.l and n''.l; the gate of Eq. (14) is open if cos_1 > 0 > cos_2
};

/// The three planes of one pixel and the eigenvalues of its normals' covariance, ascending.
struct PixelSymmetry {
  std::array<PlaneSymmetry, 3> planes;
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();

  double score() const;  ///< Eqs. (3, 13): the best plane
};

/// The operator at pixel (row, col); std::nullopt where the pixel is not valid.
std::optional<PixelSymmetry> symmetry_at(const Level& level, int row, int col,
                                         const Symmetry3dParams& params);

/// What the map of a level is multiplied by before it is added to the master map: 1, 1/maximum, or Itti's
/// N(.).
double level_weight(const cv::Mat1d& map, LevelNormalisation kind);

/// The operator at every pixel of one level: h x w, 0..4.
cv::Mat1d symmetry_map(const Level& level, const Symmetry3dParams& params);

/// The normalised maps of the levels added at full size, Eq. (15). `maps[i]` belongs to level first_level +
/// i.
cv::Mat1d master_map(const std::vector<cv::Mat1d>& maps, int first_level, cv::Size full,
                     LevelNormalisation kind);

/// The whole thing. `depth_mm` H x W, 0 = no reading. Throws as check_levels().
struct Result {
  cv::Mat1d master;               ///< H x W
  std::vector<cv::Mat1d> levels;  ///< per level, its own size, before normalisation
};
Result symmetry3d(const cv::Mat1f& depth_mm, const Intrinsics& camera, const Symmetry3dParams& params);

}  // namespace saccade::reference
