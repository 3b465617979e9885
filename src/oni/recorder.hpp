#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "core/frame.hpp"
#include "oni/writer.hpp"

namespace saccade {

/// Writes frames on a thread of its own, so that a slow disk does not delay the camera; a queue of bounded
/// length connects the two. A camera offers its frames; frames that find the queue full are dropped and
/// counted, also in the file. A source that can wait pushes its frames, and none is dropped.
///
/// The recorder syncs each frame to the disk before it writes the next, so that a power failure takes only
/// the frame being written and the queue. On a slow disk it syncs the queued frames of a camera together, at
/// least once a second, rather than drop any; counts().unsynced is the number that a power failure would
/// take. Thread safety: one thread calls offer(), push() and finish().
class OniRecorder {
 public:
  /// `capacity`: the length of the queue, >= 1. `writer` must outlive the recorder, which alone may call it.
  OniRecorder(OniWriter& writer, std::size_t capacity);
  /// Stops after the frame being written and closes the file; queued frames are lost. finish() writes them.
  ~OniRecorder();
  OniRecorder(const OniRecorder&) = delete;
  OniRecorder& operator=(const OniRecorder&) = delete;

  /// Queues a copy of the frame. False if the queue is full: the frame is dropped. Rethrows the first error
  /// of the writing thread.
  bool offer(const Frame& frame);

  /// Queues a copy of the frame, and waits for room. Rethrows the first error of the writing thread.
  void push(const Frame& frame);

  /// Writes the queued frames and closes the file. Rethrows the first error; even then the file is closed as
  /// far as possible.
  void finish();

  /// The counts so far, with the drops of the queue.
  OniWriterCounts counts() const;
  std::uint64_t size_bytes() const;

 private:
  void work();
  void add(std::unique_lock<std::mutex>& lock, const Frame& frame);
  void rethrow();
  bool time_to_sync(std::chrono::steady_clock::time_point last) const;

  OniWriter& writer_;
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> queue_;     // guarded by mutex_, like all below
  std::deque<Frame> recycled_;  // frames whose memory is reused
  std::uint64_t dropped_ = 0;
  bool finishing_ = false, abandoned_ = false;
  bool source_waits_ = false;  // frames are pushed
  std::exception_ptr error_;
  OniWriterCounts counts_;
  std::uint64_t size_bytes_ = 0;
  std::jthread thread_;
};

}  // namespace saccade
