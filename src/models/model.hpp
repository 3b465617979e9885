#pragma once

#include <memory>
#include <string_view>

#include "core/frame.hpp"
#include "core/settings.hpp"
#include "core/stage_times.hpp"
#include "core/worker_pool.hpp"
#include "saliency/symmetry3d.hpp"

namespace saccade {

/// Something that gives each pixel of a frame a saliency. Deterministic: the same frame gives the same map,
/// for any number of workers. Keeps memory between frames. Thread safety: one compute() at a time per object.
class SaliencyModel {
 public:
  virtual ~SaliencyModel() = default;

  /// Fills maps.master (H x W of the frame, finite, >= 0) and of the by-products those that are wanted and
  /// that the model has; the others are left empty. Adds to `times`. Throws Error if it cannot work on frames
  /// like this one.
  virtual void compute(const Frame& frame, RequestedOutputs outputs, SaliencyMaps& maps,
                       StageTimes& times) = 0;
};

/// Whether the model is made with the operator of src/saliency: it sees nothing where there is no depth, and
/// the kernel, the levels and their scale and normalisation are settings of it.
bool needs_depth(std::string_view model);

/// Throws Error (usage) if the settings do not fit images of this size (symmetry3d and combined: see
/// check_levels()) or ask to dump by-products that the model does not have.
void check_model(const Settings& settings, cv::Size image);

/// The model named by settings.model. `pool` must outlive it. Throws Error (usage) if this machine cannot run
/// it.
std::unique_ptr<SaliencyModel> make_model(const Settings& settings, WorkerPool& pool);

}  // namespace saccade
