#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "pipeline/result.hpp"

namespace saccade {

/// Threads that write results, so that encoding pictures does not delay the operator. The slots of the
/// pipeline bound the queue.
class WriterPool {
 public:
  /// `threads` >= 0; with 0, submit() itself writes. `write` runs on any of the threads.
  WriterPool(int threads, std::function<void(const Result&)> write);

  /// Writes all submitted results first. Errors that finish() did not rethrow are lost.
  ~WriterPool();
  WriterPool(const WriterPool&) = delete;
  WriterPool& operator=(const WriterPool&) = delete;

  /// Takes a result. Rethrows the first error of an earlier write.
  void submit(ResultHandle result);

  /// Waits until all results are written. Rethrows the first error.
  void finish();

 private:
  void work();
  void rethrow_error(std::unique_lock<std::mutex>& lock);

  std::function<void(const Result&)> write_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ResultHandle> queue_;  // guarded by mutex_, as is all below
  int busy_ = 0;
  bool closed_ = false;
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;
};

}  // namespace saccade
