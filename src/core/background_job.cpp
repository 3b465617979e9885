#include "core/background_job.hpp"

#include <utility>

namespace saccade {

BackgroundJob::BackgroundJob(std::function<void()> job) : job_(std::move(job)), thread_([this] { work(); }) {}

BackgroundJob::~BackgroundJob() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
}

void BackgroundJob::start() {
  {
    const std::lock_guard lock(mutex_);
    running_ = true;
  }
  changed_.notify_all();
}

void BackgroundJob::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !running_; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void BackgroundJob::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return running_ || stop_; });
    if (!running_) return;
    lock.unlock();
    std::exception_ptr error;
    try {
      job_();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    error_ = std::move(error);
    running_ = false;
    changed_.notify_all();
  }
}

}  // namespace saccade
