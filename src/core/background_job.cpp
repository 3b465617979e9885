#include "core/background_job.hpp"

#include <utility>

#include "core/raise_flag.hpp"

namespace saccade {

BackgroundJob::BackgroundJob(std::function<void()> job) : job_(std::move(job)), thread_([this] { work(); }) {}

BackgroundJob::~BackgroundJob() { raise_flag(stop_, mutex_, changed_); }

void BackgroundJob::start() { raise_flag(running_, mutex_, changed_); }

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
