#pragma once

#include <memory>
#include <optional>

#include "attention/attention.hpp"
#include "models/model.hpp"
#include "pipeline/result.hpp"
#include "tracking/tracking_settings.hpp"

namespace saccade {

/// Computes a frame's saliency and attention points. One thread at a time calls process().
class FrameProcessor {
 public:
  virtual ~FrameProcessor() = default;

  /// Fills the rest of `result` from result.frame, reusing its memory. Throws Error if no frame can be
  /// processed.
  virtual void process(Result& result) = 0;
};

struct ProcessorOptions {
  ModelSettings model;
  AttentionSettings attention;
  std::optional<TrackingSettings> tracking{};  ///< attention over time; none: frames are taken one by one
  RequestedOutputs outputs{};
  int workers = 1;  ///< threads, the calling one among them; >= 1
};

/// A model followed by a selector or, with tracking, by AttentionTracker; frames are then processed in the
/// order of their sequence. The results do not depend on the number of workers. Throws Error (usage) if this
/// machine cannot run the model.
[[nodiscard]] std::unique_ptr<FrameProcessor> make_processor(const ProcessorOptions& options);

}  // namespace saccade
