#pragma once

#include <memory>
#include <optional>

#include "attention/attention.hpp"
#include "models/model.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

/// What computes one side of a ViewResult: one model and one selector, remade when the settings say so. One
/// thread at a time.
class ModelRunner {
 public:
  /// `pool` must outlive it.
  explicit ModelRunner(WorkerPool& pool) : pool_(pool) {}

  /// Fills `out`, of which result.frame is filled. What cannot be computed is told in out.error. `last`, if
  /// not null, is a result of the same frame by any runner: what the settings leave as it was is taken from
  /// it, which gives the same as computing it again. Throws WorkerPool::Interrupted.
  void compute(const Settings& settings, RequestedOutputs outputs, const Computed* last, Computed& out);

 private:
  void prepare(const Settings& settings, cv::Size image);
  void find_maps(const Settings& settings, RequestedOutputs outputs, const Computed* last, Computed& out);

  WorkerPool& pool_;
  std::unique_ptr<SaliencyModel> model_;
  std::unique_ptr<AttentionSelector> selector_;
  Settings made_;
};

/// Whether the maps of `of` are those that these settings give for its frame, with all by-products that are
/// wanted.
bool has_maps(const Computed& of, Settings settings, RequestedOutputs outputs);

/// The settings of a first draft for images of this size, of at most about 50 ms of the operator on two
/// processors: windows of about the same size on the image, from coarser levels with smaller kernels. None if
/// the settings themselves take no longer, or their model has no levels.
std::optional<Settings> draft_of(Settings settings, cv::Size image);

}  // namespace saccade
