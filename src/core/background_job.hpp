#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace saccade {

/// A thread that does one job at a time beside the calling one. Thread safety: start() and wait() are called
/// by one thread.
class BackgroundJob {
 public:
  /// `job` is what each start() does once.
  explicit BackgroundJob(std::function<void()> job);
  /// Waits for a job that runs.
  ~BackgroundJob();
  BackgroundJob(const BackgroundJob&) = delete;
  BackgroundJob& operator=(const BackgroundJob&) = delete;

  /// Starts the job. The last one must have been waited for. Takes no memory.
  void start();

  /// Returns when the job is done, at once if none was started; rethrows its exception.
  void wait();

 private:
  void work();

  std::function<void()> job_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool running_ = false, stop_ = false;  // guarded by mutex_
  std::exception_ptr error_;             // guarded by mutex_
  std::jthread thread_;
};

}  // namespace saccade
