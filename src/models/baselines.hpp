#pragma once

#include "models/model.hpp"

namespace saccade {

/// `random`: each pixel independent and uniform in 0..1, drawn from the frame's index alone: the same frame
/// of any source always has the same map. Needs neither depth nor colour.
class RandomModel : public SaliencyModel {
 public:
  explicit RandomModel(WorkerPool& pool) : pool_(pool) {}
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  WorkerPool& pool_;
};

/// `centre`: 1 in the middle of the image, falling as a Gaussian whose sigma is a quarter of the width across
/// and a quarter of the height down. Needs neither depth nor colour.
class CentreModel : public SaliencyModel {
 public:
  explicit CentreModel(WorkerPool& pool) : pool_(pool) {}
  void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps, StageTimes& times) override;

 private:
  WorkerPool& pool_;
  std::vector<float> across_;
};

}  // namespace saccade
