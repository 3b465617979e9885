#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <mutex>

#include "attention/attention.hpp"
#include "pipeline/processor.hpp"
#include "settings/settings.hpp"

namespace saccade::python {

/// The results for one frame, with memory of their own.
struct FrameResult {
  SaliencyMaps maps;
  Attention attention;
};

/// What the source of a frame says of all its frames; an image of the user's own is a single one with depth.
struct FrameOrigin {
  bool has_depth = true;
  bool sequence = false;
};

/// A model with a selector or a tracker, as `saccade run` uses them: the same settings and frames give the
/// same bits. Any thread may call; calls wait for one another.
class Saliency {
 public:
  /// Throws Error (usage) if this machine cannot run the model.
  Saliency(const Settings& settings, RequestedOutputs outputs);
  ~Saliency();

  Saliency(const Saliency&) = delete;
  Saliency& operator=(const Saliency&) = delete;

  /// A frame of index -1 follows the last one: it gets the next index and, if its time is below 0, a time of
  /// 30 frames a second. Throws Error as FrameProcessor::process(), and (usage) if the levels do not fit the
  /// image, the model needs depth that is not there, attention over time is asked for without `proto`, or
  /// this is a fork of the process that made the object.
  [[nodiscard]] FrameResult compute(Frame frame, const FrameOrigin& origin);

  /// Forgets the frames so far: the next one begins a sequence.
  void reset();

 private:
  void check_process() const;
  void prepare(cv::Size size, const FrameOrigin& origin);

  const ::pid_t process_;  // whose threads the processor has; a fork does not have them
  std::mutex mutex_;
  Settings settings_;
  RequestedOutputs outputs_;
  std::unique_ptr<FrameProcessor> processor_;
  cv::Size size_{};  // that the processor was made for
  FrameOrigin origin_;
  std::int64_t next_index_ = 0;
};

}  // namespace saccade::python
