#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "attention/attention.hpp"
#include "models/model.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// Computes one side of a ViewResult with one model and one selector, which it makes again when their
/// settings change. One thread at a time.
class ModelRunner {
 public:
  /// `pool` must outlive it.
  explicit ModelRunner(WorkerPool& pool) : pool_(pool) {}

  /// Chooses the attention points of `out`, which has its frame, map and smoothed map.
  using Attend = std::function<void(Computed& out)>;

  /// Computes out.result.frame and fills the rest of `out`; a failure is reported in out.error. `last`, if
  /// not null, is a result of the same frame by any runner: its maps, and its attention, are copied where the
  /// settings have not changed, which gives the same as computing them. `attend`: chooses the points in place
  /// of the selector; may be empty. Throws WorkerPool::Interrupted.
  void compute(const Settings& settings, RequestedOutputs outputs, const Computed* last, Computed& out,
               const Attend& attend = {});

 private:
  void prepare(const Settings& settings, cv::Size image);
  void find_maps(const Settings& settings, RequestedOutputs outputs, const Computed* last, Computed& out);

  WorkerPool& pool_;
  std::unique_ptr<SaliencyModel> model_;
  std::unique_ptr<AttentionSelector> selector_;
  Settings made_;
};

/// Whether `of` holds the maps that these settings give for its frame, with the requested by-products.
[[nodiscard]] bool has_maps(const Computed& of, Settings settings, RequestedOutputs outputs);

/// Settings for a draft that the operator computes within about 50 ms on two processors: coarser levels with
/// smaller kernels, so that the windows cover about the same part of the image. None if the settings
/// themselves are as quick, or their model has no levels.
[[nodiscard]] std::optional<Settings> draft_of(Settings settings, cv::Size image);

}  // namespace saccade
