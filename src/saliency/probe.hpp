#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "saliency/params.hpp"
#include "saliency/reference.hpp"

namespace saccade {

/// One pyramid level at a probed pixel.
struct LevelProbe {
  int level = 0;
  cv::Point pixel;          ///< the pixel of this level that is nearest to the probed one
  double depth_mm = 0;      ///< there; 0 = no reading
  cv::Rect2d footprint_px;  ///< the window around it in pixels of level 0, not clipped; (0,0) is the centre
                            ///< of the top-left pixel
  double footprint_mm = 0;  ///< the window's width at depth_mm; 0 = no reading
  double score = 0;         ///< s at `pixel`, 0..4
  double contribution = 0;  ///< to the master map at the probed pixel, Eq. (15)
  std::optional<reference::PixelSymmetry> symmetry{};  ///< at `pixel`; none without a normal there

  /// The index of the plane with the best score; none if all score 0.
  std::optional<std::size_t> winner() const;
};

/// The operator's result at one pixel, with everything that led to it.
struct Probe {
  int row = 0, col = 0;
  double depth_mm = 0;                ///< 0 = no reading
  cv::Point3d position_mm;            ///< camera frame; (0,0,0) = no reading
  std::optional<cv::Vec3d> normal{};  ///< unit, towards the camera, of level 0
  double saliency = 0;                ///< the sum of the levels' contributions
  std::vector<LevelProbe> levels;     ///< first_level..last_level
};

/// Probes pixel (row, col) of a depth image (H x W, mm, 0 = no reading) with the reference form of the
/// operator, on that part of the image that its windows cover: a few milliseconds. `level_weights` are the
/// factors of the levels in Eq. (15); empty = all 1, which is right for LevelNormalisation::none. The result
/// is that of reference::symmetry3d() at this pixel. Throws as check_levels(); std::invalid_argument for a
/// pixel outside the image, or if there is not one weight for each level.
Probe probe(const cv::Mat1f& depth_mm, const Intrinsics& camera, const Symmetry3dParams& params, int row,
            int col, std::span<const double> level_weights = {});

/// Says in a few words why a plane scores 0, or that it scores.
std::string_view to_string(reference::PlaneVerdict verdict);

}  // namespace saccade
