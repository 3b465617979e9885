#pragma once

#include "models/model.hpp"

namespace saccade {

/// `random`: each pixel independent and uniform in [0, 1), from a generator seeded with the frame's index:
/// frame n of any source has the same map. Needs neither depth nor colour.
class RandomModel : public SaliencyModel {
 public:
  explicit RandomModel(WorkerPool& pool) : pool_(pool) {}
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  WorkerPool& pool_;
};

/// `centre`: a Gaussian, 1 in the middle of the image, with sigma a quarter of the width horizontally and a
/// quarter of the height vertically. Needs neither depth nor colour.
class CentreModel : public SaliencyModel {
 public:
  explicit CentreModel(WorkerPool& pool) : pool_(pool) {}
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  WorkerPool& pool_;
  std::vector<float> across_;
};

}  // namespace saccade
