#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "core/stage_times.hpp"
#include "core/worker_pool.hpp"
#include "saliency/params.hpp"

namespace saccade {

/// Which by-products of the operator to compute besides the master map.
struct RequestedOutputs {
  bool levels = false;   ///< the map of every level
  bool normals = false;  ///< the normals of level 0
  bool operator==(const RequestedOutputs&) const = default;
};

/// What the operator computes from one frame of H x W pixels.
struct SaliencyMaps {
  cv::Mat1f master;               ///< H x W, the sum of the levels, Eq. (15); at least 0
  std::vector<cv::Mat1f> levels;  ///< if requested: the map of level first_level + i at its own size, 0..4,
                                  ///< before normalisation; 0 where there is no depth or no normal
  cv::Mat3f normals;              ///< if requested: H x W, unit, towards the camera; (0,0,0) = none
};

/// The production form of the operator that README.md in this folder describes: float, SIMD chosen at run
/// time, rows shared among a WorkerPool. Agrees with reference::symmetry3d() except at near-ties, where
/// rounding decides on which side of a plane a point lies; the same bits for any number of workers. Allocates
/// nothing after the first frame of a size. Thread safety: one compute() at a time per object.
class Symmetry3d {
 public:
  /// `simd` as in ModelSettings::simd; throws Error (usage) if this machine cannot run it. `pool` must
  /// outlive this object.
  Symmetry3d(const Symmetry3dParams& params, WorkerPool& pool, const std::string& simd = "auto");
  ~Symmetry3d();
  Symmetry3d(const Symmetry3d&) = delete;
  Symmetry3d& operator=(const Symmetry3d&) = delete;

  /// `depth_mm`: H x W; values that are not above 0 and at most 65535 mm count as no reading. Overwrites
  /// `maps`, reusing its memory, and adds to `times`. Throws as check_levels(); std::invalid_argument for a
  /// camera that is not valid(); WorkerPool::Interrupted.
  void compute(const cv::Mat1f& depth_mm, const Intrinsics& camera, RequestedOutputs outputs,
               SaliencyMaps& maps, StageTimes& times);

  /// The same without the master map, which stays as it is: for those who add the levels in their own way.
  void compute_levels(const cv::Mat1f& depth_mm, const Intrinsics& camera, RequestedOutputs outputs,
                      SaliencyMaps& maps, StageTimes& times);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace saccade
