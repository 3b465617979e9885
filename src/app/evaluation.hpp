#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "core/file.hpp"
#include "core/frame_source.hpp"
#include "core/worker_pool.hpp"
#include "eval/evaluator.hpp"
#include "eval/result_file.hpp"

namespace saccade {

/// Evaluates the frames of a plan that have no result yet, as many at once as `pool` has workers, each on one
/// thread.
class Evaluation {
 public:
  /// All three must outlive it. Throws Error as make_model().
  Evaluation(const EvalPlan& plan, FrameSource& source, WorkerPool& pool);

  /// Evaluates the positions of the plan that are not `known` and appends them to the file. Calls `begin`
  /// before it appends the first that can be used. At the end warns if images were left out, unless all were.
  /// False if the interrupt ended it early. Throws Error.
  [[nodiscard]] bool run(const std::vector<bool>& known, LineFile& file, Progress& progress,
                         const Interrupt& interrupt, const std::function<void()>& begin);

 private:
  struct Batch {
    std::vector<ImageResult> images;
    std::vector<std::size_t> readable;  ///< indices of images; the frame of the k-th is frames_[k]
  };

  void read(std::int64_t index, Batch& batch);
  void evaluate(Batch& batch);

  const EvalPlan& plan_;
  FrameSource& source_;
  WorkerPool& pool_;
  std::vector<Frame> frames_;  ///< of a batch
  std::vector<std::unique_ptr<WorkerPool>> lane_pools_;
  std::vector<std::unique_ptr<Evaluator>> lanes_;
};

}  // namespace saccade
