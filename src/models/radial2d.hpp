#pragma once

#include <array>
#include <vector>

#include "models/model.hpp"

namespace saccade {

/// `radial2d`: the fast radial symmetry transform (Loy and Zelinsky, "Fast radial symmetry for detecting
/// points of interest", PAMI 2003) of the grey image with radii 1, 3, 5 and alpha = 2. Each pixel with a
/// gradient votes for the pixels at radius n ahead of it (+) and behind it (-); with votes O and M,
///   F = M/k (min(|O|, k)/k)^2,   S = mean over n of F blurred by a Gaussian of sigma n/4,
/// k = 8 for n = 1 and 9.9 for the others. The map is |S|: bright and dark spots count alike. Needs colour.
class Radial2dModel : public SaliencyModel {
 public:
  explicit Radial2dModel(WorkerPool& pool) : pool_(pool) {}
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  static constexpr std::array<int, 3> kRadii = {1, 3, 5};

  // Votes of one radius.
  struct Votes {
    cv::Mat1i orientation;  ///< O
    cv::Mat1f magnitude;    ///< M, then F, then S
  };

  void find_gradient(const cv::Mat3b& colour);
  void vote(int radius, Votes& votes) const;

  WorkerPool& pool_;
  cv::Mat1b grey_;
  cv::Mat1s gx_, gy_;
  cv::Mat1f length_;
  std::array<Votes, kRadii.size()> votes_;
};

}  // namespace saccade
