#pragma once

#include <memory>
#include <vector>

#include "models/model.hpp"

namespace saccade {

/// `combined`: 3D symmetry together with the Itti model and 2D symmetry; README.md of this folder says why it
/// is made so. Needs depth and colour. By-products are those of symmetry3d.
///
///  1. The map of each pyramid level l of symmetry3d is weighted with the depth z of the pixel,
///       w_l(z) = 1/(1 + (z/(z_0 2^l))^2),   z_0 = 500 mm:
///     the noise of a sensor grows with z^2 and each level smooths it; where it is large, fine levels find
///     symmetry in noise. The weighted levels are added as in Eq. (15).
///  2. This map, that of itti and that of symmetry2d are reduced to 1/4 of the image, smoothed by a Gaussian
///     of 6 px and divided by their maximum.
///  3. They are added with more trust t in 3D the nearer the scene is, z being the median depth of the frame,
///       (1/2 + t/2) * 3D + (1 - t) * (itti + 1/4 * symmetry2d),   t = 1/(1 + (z/z_1)^4),   z_1 = 1000 mm,
///     and the sum is brought back to full size. Without any depth t = 0, and the image alone counts.
class CombinedModel : public SaliencyModel {
 public:
  /// Throws Error (usage) as Symmetry3d.
  CombinedModel(const ModelSettings& settings, WorkerPool& pool);
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  void weigh_levels(const cv::Mat1f& depth_mm);
  void reduce(const cv::Mat1f& map, cv::Mat1f& reduced);
  float trust_in_3d(const cv::Mat1f& depth_mm);

  WorkerPool& pool_;
  int first_level_;
  Symmetry3d symmetry3d_;
  std::unique_ptr<SaliencyModel> itti_, symmetry2d_;
  SaliencyMaps maps3d_, maps_itti_, maps2d_;
  std::vector<cv::Mat1f> sums_;  ///< of the weighted levels, by level
  cv::Mat1f half_, reduced3d_, reduced_itti_, reduced2d_;
  std::vector<float> depths_;
};

}  // namespace saccade
