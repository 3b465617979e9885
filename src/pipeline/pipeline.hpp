#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/frame_source.hpp"
#include "pipeline/frame_settings.hpp"
#include "pipeline/ledger.hpp"
#include "pipeline/mailbox.hpp"
#include "pipeline/processor.hpp"
#include "pipeline/result.hpp"
#include "pipeline/ring.hpp"
#include "pipeline/source_state_notifier.hpp"
#include "pipeline/stage_statistics.hpp"

namespace saccade {

enum class FramePolicy {
  every_frame,  ///< all frames, in order; capture waits while no slot is free
  newest,       ///< capture never waits; a frame that a newer one overtakes is dropped
};

/// Slots that keep every stage busy: one captured, one computed, one waiting on either side.
inline constexpr int kSlotsInFlight = 4;

struct PipelineOptions {
  FrameSettings frames;  ///< its limit counts captured frames (every_frame) or results (newest)
  FramePolicy policy = FramePolicy::every_frame;
  /// Frames in memory: >= 2, and >= 3 for `newest`, of which the consumer may hold all but two.
  int slots = kSlotsInFlight;
  /// Called for each frame that cannot be used: on the capture thread, or on the compute thread if the model
  /// cannot use it (it throws Error, unreadable, e.g. for a frame without colour).
  std::function<void(std::int64_t index, const std::string& reason)> on_rejected;
  /// Called on the capture thread for each frame that can be used, but lacks something: colour or labels that
  /// could not be read.
  std::function<void(std::int64_t index, const std::string& reason)> on_incomplete;
  /// Called on the capture thread with changes of the source's state (SourceStateNotifier).
  std::function<void(const SourceState&)> on_state;
};

/// From a source to results, in order:
///
///     every_frame:  capture thread --ring--> compute thread (+ its pool) --ring--> next(), consumer's thread
///                         ^------------------- slots given back --------------------'
///     newest:       capture thread <-mailbox-> compute thread (+ its pool) --ring--> next()
///                                                ^-------- slots given back ----------'
///
/// A fixed number of slots circulates, so that nothing is allocated once they have been filled. every_frame:
/// capture waits while all slots are in use (back-pressure), and nothing is dropped while it runs. newest:
/// capture and compute each hold a slot and exchange it for the one in the mailbox. Compute takes the newest
/// frame only when it has a free slot for its next result; as long as the consumer keeps up, the time from
/// capture to result is therefore at most the time for one frame to arrive and one to be computed.
/// next() rethrows an exception of either thread, after the results before it; the exception ends the stream.
class Pipeline {
 public:
  /// Starts at once. Throws std::invalid_argument for options out of range.
  Pipeline(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor,
           PipelineOptions options);

  /// Stops and joins. All handles must have been destroyed.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// The next result; empty at the end. Rethrows the exception that ended the stream. One thread at a time.
  ResultHandle next();

  /// Ends the stream early: capture stops, waiting frames are dropped and counted, and the frame being
  /// computed is finished. next() still returns the computed results, then ends. Any thread, any number of
  /// times.
  void stop() noexcept;

  /// A consistent snapshot. Any thread. No frame is in flight when next() has returned empty or thrown.
  Ledger ledger() const { return counters_.snapshot(); }

  /// The times from the capture of a frame to its result from next(). Thread of next() only.
  const DurationHistogram& latency() const { return latency_; }

  /// The state of the source. Any thread.
  SourceState source_state() const { return source_->state(); }

  /// The controls of the source's sensor; nullptr if it has none. They live as long as the pipeline.
  SensorControls* controls() { return source_->controls(); }

 private:
  friend struct ReturnSlot;

  bool keeps_newest() const { return options_.policy == FramePolicy::newest; }
  void capture() noexcept;
  void capture_frames();
  ReadResult read_into(Result& slot);
  Result* hand_over(Result* slot);
  void compute() noexcept;
  enum class Processing { done, rejected, failed };
  Processing process(Result& slot) noexcept;
  void reject(std::int64_t index, const std::string& reason);
  void give_back(Result* slot) noexcept;
  void fail(std::exception_ptr error) noexcept;

  std::unique_ptr<FrameSource> source_;
  std::unique_ptr<FrameProcessor> processor_;
  PipelineOptions options_;
  std::vector<std::unique_ptr<Result>> slots_;
  // In each ring a null pointer is the end mark (in free_: a stop request).
  Ring<Result*> free_, captured_, computed_;
  Mailbox<Result> newest_;
  std::mutex give_back_mutex_;  // any thread gives slots back, and a ring allows one producer at a time
  std::atomic<bool> stopping_ = false;
  LedgerCounters counters_;
  std::int64_t results_ = 0;      // compute thread only
  SourceStateNotifier notifier_;  // capture thread only
  std::mutex error_mutex_;
  std::exception_ptr error_;   // guarded by error_mutex_; the first
  bool ended_ = false;         // consumer's thread only
  DurationHistogram latency_;  // consumer's thread only
  std::jthread compute_thread_, capture_thread_;
};

}  // namespace saccade
