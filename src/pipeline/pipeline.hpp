#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/frame_source.hpp"
#include "pipeline/ledger.hpp"
#include "pipeline/processor.hpp"
#include "pipeline/result.hpp"
#include "pipeline/ring.hpp"

namespace saccade {

/// Which frames of a source are taken.
struct FrameSelection {
  std::int64_t start = 0;  ///< index of the first
  std::int64_t every = 1;  ///< each n-th from there, >= 1
  std::int64_t limit = 0;  ///< at most so many, 0 = all
};

struct PipelineOptions {
  FrameSelection selection;
  std::optional<Intrinsics> intrinsics;  ///< instead of what the source says
  int slots = 4;                         ///< frames in memory at once, >= 2
  /// Called on the capture thread for each frame that cannot be used.
  std::function<void(std::int64_t index, const std::string& reason)> on_rejected;
};

/// From a source to results, every frame and in order:
///
///     capture thread --ring--> compute thread (+ its worker pool) --ring--> next(), the consumer's thread
///           ^----------------------- slots given back -----------------------------'
///
/// A fixed number of slots circulates; when all are in use capture waits (back-pressure), so nothing is
/// dropped while it runs and nothing is allocated once the slots have been filled. An exception of either
/// thread ends the stream and reaches the consumer from next(), after the results that came before it.
class Pipeline {
 public:
  /// Starts at once. Throws std::invalid_argument for options out of range.
  Pipeline(std::unique_ptr<FrameSource> source, std::unique_ptr<FrameProcessor> processor,
           PipelineOptions options);

  /// Stops and joins. All handles must have been destroyed.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  /// The next result; empty at the end. Rethrows what ended the stream early. One thread at a time.
  ResultHandle next();

  /// Ends the stream early: no more capture, frames waiting for their turn are dropped and counted, the one
  /// being computed is finished. next() still gives what is computed, then ends. Any thread, any number of
  /// times.
  void stop() noexcept;

  /// A consistent snapshot. Any thread. When next() has returned empty or thrown, nothing is in flight.
  Ledger ledger() const;

 private:
  friend struct ReturnSlot;

  void capture() noexcept;
  void capture_frames();
  ReadResult read_into(Result& slot);
  void compute() noexcept;
  void give_back(Result* slot) noexcept;
  void fail(std::exception_ptr error) noexcept;
  void count(std::int64_t Ledger::*field) noexcept;

  std::unique_ptr<FrameSource> source_;
  std::unique_ptr<FrameProcessor> processor_;
  PipelineOptions options_;
  std::vector<std::unique_ptr<Result>> slots_;
  // In each ring a null pointer is the end mark (in free_: the wish to stop).
  Ring<Result*> free_, captured_, computed_;
  std::mutex give_back_mutex_;  // any thread gives slots back; the ring allows one producer at a time
  std::atomic<bool> stopping_ = false;
  mutable std::mutex mutex_;
  Ledger ledger_;             // guarded by mutex_
  std::exception_ptr error_;  // guarded by mutex_; the first
  bool ended_ = false;        // consumer's thread only
  std::jthread compute_thread_, capture_thread_;
};

}  // namespace saccade
