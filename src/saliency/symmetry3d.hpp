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

/// Which by-products of the operator a caller wants besides the master map.
struct RequestedOutputs {
  bool levels = false;   ///< the map of every level
  bool normals = false;  ///< the normals of level 0
};

struct SaliencyMaps {
  cv::Mat1f master;  ///< H x W, the sum of the levels, Eq. (15)
  std::vector<cv::Mat1f>
      levels;         ///< if wanted: level first_level + i at its own size, 0..4, before normalisation
  cv::Mat3f normals;  ///< if wanted: H x W, unit, towards the camera, (0,0,0) = none
};

/// The production form of the operator: float, SIMD chosen at run time, rows shared among a WorkerPool.
/// Agrees with reference::symmetry3d() up to near-ties of the eigenvectors; the same bits for any number of
/// workers. Memory is kept between frames: nothing is allocated after the first of one size. Thread safety:
/// one compute() at a time per object.
class Symmetry3d {
 public:
  /// `simd` as in ModelSettings::simd; throws Error (usage) if this machine cannot run it. `pool` must outlive
  /// this.
  Symmetry3d(const Symmetry3dParams& params, WorkerPool& pool, const std::string& simd = "auto");
  ~Symmetry3d();
  Symmetry3d(const Symmetry3d&) = delete;
  Symmetry3d& operator=(const Symmetry3d&) = delete;

  /// depth_mm: H x W, 0 = no reading. Overwrites what `maps` holds, reusing its memory, and adds to `times`.
  /// Throws as check_levels().
  void compute(const cv::Mat1f& depth_mm, const Intrinsics& camera, RequestedOutputs outputs,
               SaliencyMaps& maps, StageTimes& times);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace saccade
