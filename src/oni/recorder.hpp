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

/// Writes frames on a thread of its own, so that a slow disk does not hold up the camera: between the two is
/// a queue of bounded length. A camera offers its frames, and those that find the queue full are dropped and
/// counted, also in the file; a source that can wait pushes them, and none is dropped.
///
/// Each frame is made to reach the disk before the next is written, so that a power cut takes no more than
/// the frame being written and those that wait. A disk too slow for that gets the frames that came meanwhile
/// together (still at least once a second), rather than that any is dropped; counts().unsynced tells how many
/// frames are at stake.
/// Thread safety: one thread calls offer(), push() and finish().
class OniRecorder {
 public:
  /// `capacity` >= 1 frames wait at most. `writer` must outlive this, and nobody else calls it meanwhile.
  OniRecorder(OniWriter& writer, std::size_t capacity);
  /// Stops after the frame that is being written; what waits is lost. Call finish() for a whole file.
  ~OniRecorder();
  OniRecorder(const OniRecorder&) = delete;
  OniRecorder& operator=(const OniRecorder&) = delete;

  /// Takes a copy of the frame if there is room, and returns whether there was. Rethrows the first error of
  /// the writing thread.
  bool offer(const Frame& frame);

  /// Takes a copy of the frame, and waits for room. Rethrows the first error of the writing thread.
  void push(const Frame& frame);

  /// Writes what waits and closes the file. Rethrows the first error; the file is closed then too, as far as
  /// that was possible.
  void finish();

  /// What is written so far, drops of the queue included.
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
  std::deque<Frame> queue_;     // guarded by mutex_, as is all below
  std::deque<Frame> recycled_;  // frames whose memory is used again
  std::uint64_t dropped_ = 0;
  bool finishing_ = false, abandoned_ = false;
  bool source_waits_ = false;  // frames are pushed
  std::exception_ptr error_;
  OniWriterCounts counts_;
  std::uint64_t size_bytes_ = 0;
  std::jthread thread_;
};

}  // namespace saccade
