#pragma once

#include <chrono>
#include <memory>

#include "attention/attention.hpp"
#include "core/frame.hpp"
#include "core/stage_times.hpp"
#include "saliency/symmetry3d.hpp"

namespace saccade {

/// A frame and all that was computed from it. Its memory belongs to the pipeline and is used again.
struct Result {
  Frame frame;
  SaliencyMaps maps;
  Attention attention;
  StageTimes times;
  std::chrono::steady_clock::time_point captured_at;  ///< when the source had delivered the frame
};

class Pipeline;

/// Gives the result's slot back to its pipeline; on any thread.
struct ReturnSlot {
  Pipeline* pipeline = nullptr;
  void operator()(Result* result) const;
};

/// The consumer's hold on one result. Hold few and not for long: a held slot is one that the pipeline waits
/// for. Must not outlive the pipeline.
using ResultHandle = std::unique_ptr<Result, ReturnSlot>;

}  // namespace saccade
