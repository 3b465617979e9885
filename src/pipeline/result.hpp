#pragma once

#include <chrono>
#include <memory>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "core/stage_times.hpp"
#include "saliency/symmetry3d.hpp"

namespace saccade {

/// A frame and the results for it. Its memory belongs to the pipeline and is reused.
struct Result {
  Frame frame;
  SaliencyMaps maps;
  Attention attention;
  StageTimes times;
  std::chrono::steady_clock::time_point captured_at;  ///< when the source delivered the frame
};

class Pipeline;

/// Returns the slot of a result to its pipeline. Any thread.
struct ReturnSlot {
  Pipeline* pipeline = nullptr;
  void operator()(Result* result) const;
};

/// The consumer's ownership of one result. Keep few and not for long, since the pipeline waits for free
/// slots. Must not outlive the pipeline.
using ResultHandle = std::unique_ptr<Result, ReturnSlot>;

}  // namespace saccade
