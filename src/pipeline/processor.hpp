#pragma once

#include <memory>

#include "core/settings.hpp"
#include "core/worker_pool.hpp"
#include "pipeline/result.hpp"

namespace saccade {

/// Computes a frame's saliency and attention. One thread at a time calls process().
class FrameProcessor {
 public:
  virtual ~FrameProcessor() = default;

  /// `result.frame` is filled; fills the rest, reusing its memory. Throws Error if no frame can be processed.
  virtual void process(Result& result) = 0;
};

/// The model and the selector that `settings` asks for, on settings.workers threads (the calling one among
/// them). Throws Error (usage) if this machine cannot run what is asked.
std::unique_ptr<FrameProcessor> make_processor(const Settings& settings);

/// settings.workers, with 0 resolved to the number of processors.
int worker_count(const Settings& settings);

}  // namespace saccade
