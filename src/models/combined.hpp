#pragma once

#include <memory>
#include <vector>

#include "models/itti.hpp"
#include "models/mirror_pairs.hpp"
#include "models/model.hpp"

namespace saccade {

/// `combined`: 3D symmetry together with the Itti model and 2D symmetry; README.md of this folder says why it
/// is made so. Needs depth and colour. By-products are those of symmetry3d.
///
///  1. The map of each pyramid level l of symmetry3d is weighted with the depth z of the pixel,
///       w_l(z) = 1/(1 + (z/(z_0 2^l))^2),   z_0 = 500 mm:
///     the noise of a sensor grows with z^2 and each level smooths it; where it is large, fine levels find
///     symmetry in noise. The weighted levels are added as in Eq. (15).
///  2. itti and symmetry2d, the latter without its finest level, are computed from the halved image. Their
///     maps and x, the map of step 1, are brought to 1/4 of the image, smoothed by a Gaussian of 6 px and
///     divided by their maximum; so is the image's saliency I = itti + 1/4 symmetry2d.
///  3. A place is salient if it stands out in either, and more so if there is any 3D evidence at it:
///       S = (1 - (1 - b x)(1 - I)) (a + (1 - a) x/(x + e)),   b = 0.5, a = 0.35, e = 0.002,
///     brought back to full size; range 0..1. Without any depth S = a I, and the image alone counts.
class CombinedModel : public SaliencyModel {
 public:
  /// Throws Error (usage) as Symmetry3d.
  CombinedModel(const ModelSettings& settings, WorkerPool& pool);
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  void weigh_levels(const cv::Mat1f& depth_mm);
  void reduce(const cv::Mat1f& itti, const cv::Mat1f& symmetry2d);
  void combine();

  WorkerPool& pool_;
  int first_level_;
  Symmetry3d symmetry3d_;
  IttiModel itti_;
  std::unique_ptr<MirrorPairModel> symmetry2d_;
  SaliencyMaps maps3d_;
  std::vector<cv::Mat1f> sums_;  ///< of the weighted levels, by level
  cv::Mat3b half_colour_;
  cv::Mat1f half_, reduced3d_, reduced_itti_, reduced2d_;
};

}  // namespace saccade
