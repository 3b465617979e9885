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

/// Threads that write results, so that encoding pictures does not hold up the operator. The queue is bounded
/// by the pipeline's slots: whoever holds all of them waits.
class WriterPool {
 public:
  /// `threads` >= 0; with none submit() writes at once. `write` runs on any of the threads.
  WriterPool(int threads, std::function<void(const Result&)> write);

  /// Waits for what was submitted; errors not fetched by finish() are lost.
  ~WriterPool();
  WriterPool(const WriterPool&) = delete;
  WriterPool& operator=(const WriterPool&) = delete;

  /// Hands over a result. Rethrows the first error of an earlier write.
  void submit(ResultHandle result);

  /// Waits until all is written. Rethrows the first error.
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
