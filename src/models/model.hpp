#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/frame.hpp"
#include "core/stage_times.hpp"
#include "core/worker_pool.hpp"
#include "models/model_settings.hpp"
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

/// One model of the table.
struct ModelInfo {
  std::string_view name;
  std::string_view help;  ///< one line
  /// True if it is made with the operator of src/saliency: it sees nothing where there is no depth, kernel,
  /// levels, length scale and normalisation are parameters of it, and it has the by-products of the operator.
  bool needs_depth;
  std::unique_ptr<SaliencyModel> (*make)(const ModelSettings& settings, WorkerPool& pool);
};

/// All models, in the order of the help.
std::span<const ModelInfo> models();

/// The names of the models that need depth, or of those that do not.
std::vector<std::string_view> model_names(bool needs_depth);

/// See ModelInfo::needs_depth. Throws std::invalid_argument for an unknown name.
bool needs_depth(std::string_view model);

/// Throws Error (usage) if the settings do not fit images of this size; see check_levels().
void check_model(const ModelSettings& settings, cv::Size image);

/// The model named by settings.model. `pool` must outlive it. Throws Error (usage) if this machine cannot run
/// it, std::invalid_argument for an unknown name.
[[nodiscard]] std::unique_ptr<SaliencyModel> make_model(const ModelSettings& settings, WorkerPool& pool);

}  // namespace saccade
