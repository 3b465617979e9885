#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace saccade {

/// A fixed set of threads that share the chunks of one job at a time. The calling thread works too, so a pool
/// of one has no thread of its own. Chunks start in order, each exactly once, on any of the threads: a job
/// whose chunks write disjoint memory gives the same bits for any number of workers. Thread safety: one
/// thread at a time calls for_each(), and never from inside a job; any thread calls interrupt() and resume().
class WorkerPool {
 public:
  /// Thrown by for_each() after interrupt().
  struct Interrupted {};

  /// `workers` >= 1 counts the calling thread; throws std::invalid_argument otherwise.
  explicit WorkerPool(int workers);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int workers() const { return static_cast<int>(threads_.size()) + 1; }

  /// Runs job(chunk, worker) for every chunk in [0, chunks); worker in [0, workers()) names the thread, for
  /// scratch memory. Returns when all are done. Rethrows the first exception of a job after the other threads
  /// have finished their chunks; the chunks not begun by then are skipped. Allocates nothing.
  void for_each(int chunks, const std::function<void(int chunk, int worker)>& job);

  /// For a result that is no longer needed: until resume(), no chunk is begun and for_each() throws
  /// Interrupted.
  void interrupt() noexcept { interrupted_ = true; }
  void resume() noexcept { interrupted_ = false; }

 private:
  void work(int worker);
  void take_chunks(int worker) noexcept;

  std::mutex mutex_;
  std::condition_variable start_, finish_;
  const std::function<void(int, int)>* job_ = nullptr;
  std::size_t round_ = 0;  // guarded by mutex_; a new value starts the threads
  int busy_ = 0;           // guarded by mutex_; threads still in this round
  bool stop_ = false;      // guarded by mutex_
  int chunks_ = 0;
  std::atomic<int> next_{0};
  std::atomic<bool> interrupted_ = false;
  std::exception_ptr error_;  // guarded by mutex_
  std::vector<std::jthread> threads_;
};

/// The number of processors this process may use, at least 1.
int processor_count();

}  // namespace saccade
