#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "scene/render.hpp"

namespace saccade::scene {

/// The structured-light sensor of the noise model (README 5).
struct KinectProperties {
  double focal_px = 580;         ///< of its infra-red camera, 640 px wide
  double baseline_mm = 75;       ///< the projector stands this far to the right of the camera
  double steps_per_px = 8;       ///< disparity is measured in eighths of a pixel
  double nearest_mm = 450;       ///< no reading of nearer surfaces
  double farthest_mm = 9000;     ///< no reading of farther surfaces
  double smooth_noise = 0.32;    ///< standard deviation, disparity steps; correlated over some 4 px of 640
  double white_noise = 0.24;     ///< standard deviation, disparity steps; independent per pixel
  double jump = 0.03;            ///< neighbours with a larger relative difference of depth are two surfaces
  double edge_loss = 0.3;        ///< probability of no reading near a depth jump
  double grazing_cosine = 0.25;  ///< cosine of the angle of incidence below which readings begin to fail
  double blind_cosine = 0.07;    ///< cosine below which there are none
  double random_loss = 0.002;    ///< probability of no reading anywhere

  /// Disparity, in steps, of a depth: z = focal * baseline * steps_per_px / disparity.
  double steps(double depth_mm) const { return focal_px * baseline_mm * steps_per_px / depth_mm; }
};

/// Turns exact depth into the readings of a Kinect of the first generation (README 5): integer mm, quantised
/// in disparity (so that steps and noise grow with z^2), with the projector's shadow to the left of near
/// objects, ragged and missing edges, and missing pixels on surfaces seen at a grazing angle.
/// Keeps memory between calls. Thread safety: one call at a time per object.
class KinectModel {
 public:
  explicit KinectModel(const KinectProperties& properties = {});

  /// Copies the geometry of a view and computes all that does not depend on the frame.
  void set_view(const SceneRender& view, const Intrinsics& camera);

  /// One reading of the view: H x W integer mm, 0 = no reading. The same view and key give the same bits, in
  /// any order of calls. Throws std::logic_error before the first set_view().
  void sense(std::uint64_t key, cv::Mat1f& depth_mm);

  /// Pixels of the view that the projector does not light: H x W, 255 = in shadow.
  const cv::Mat1b& shadow() const { return shadow_; }

 private:
  void cast_shadow(const cv::Mat1f& depth_mm, const Intrinsics& camera);
  void find_losses(const SceneRender& view, const Intrinsics& camera);
  void draw_lattice(std::uint64_t key, int lattice_row, std::vector<float>& values) const;
  void draw_smooth_noise(std::uint64_t key, int row);
  float sense_pixel(int row, int col, std::uint64_t bits) const;

  KinectProperties properties_;
  std::vector<float> depth_of_step_;        // mm, 0 out of range
  int cell_px_ = 0;                         // of the smooth noise
  std::vector<float> weight_, normaliser_;  // of the interpolation at each place in a cell
  cv::Mat1f steps_;                         // exact disparity; 0 = never a reading
  cv::Mat1b edge_, shadow_;
  cv::Mat1w loss_;                // probability of no reading, of 65536
  cv::Mat1f nearest_, farthest_;  // scratch
  std::vector<float> lit_;        // scratch: nearest depth in each projector column
  std::vector<float> upper_, lower_,
      noise_;  // scratch: lattice rows above and below the image row; noise of the row
};

}  // namespace saccade::scene
