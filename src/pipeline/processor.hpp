#pragma once

#include <memory>

#include "attention/attention.hpp"
#include "models/model.hpp"
#include "pipeline/result.hpp"

namespace saccade {

/// Computes a frame's saliency and attention. One thread at a time calls process().
class FrameProcessor {
 public:
  virtual ~FrameProcessor() = default;

  /// `result.frame` is filled; fills the rest, reusing its memory. Throws Error if no frame can be processed.
  virtual void process(Result& result) = 0;
};

struct ProcessorOptions {
  ModelSettings model;
  AttentionSettings attention;
  RequestedOutputs outputs{};
  int workers = 1;  ///< threads, the calling one among them; >= 1
};

/// A model followed by a selector. Throws Error (usage) if this machine cannot run the model.
[[nodiscard]] std::unique_ptr<FrameProcessor> make_processor(const ProcessorOptions& options);

}  // namespace saccade
