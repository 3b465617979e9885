#include "output/writer_pool.hpp"

#include <utility>

#include "core/raise_flag.hpp"

namespace saccade {

WriterPool::WriterPool(int threads, std::function<void(const Result&)> write) : write_(std::move(write)) {
  try {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  } catch (...) {  // the system has no more threads
    raise_flag(closed_, mutex_, changed_);
    throw;
  }
}

WriterPool::~WriterPool() {
  raise_flag(closed_, mutex_, changed_);
  threads_.clear();  // joins
}

void WriterPool::submit(ResultHandle result) {
  std::unique_lock lock(mutex_);
  rethrow_error(lock);
  if (threads_.empty()) {
    lock.unlock();
    write_(*result);
    return;
  }
  queue_.push_back(std::move(result));
  changed_.notify_all();
}

void WriterPool::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return queue_.empty() && busy_ == 0; });
  rethrow_error(lock);
}

void WriterPool::rethrow_error(std::unique_lock<std::mutex>& lock) {
  if (!error_) return;
  const std::exception_ptr error = std::exchange(error_, nullptr);
  lock.unlock();
  std::rethrow_exception(error);
}

void WriterPool::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return closed_ || !queue_.empty(); });
    if (queue_.empty()) return;
    ResultHandle result = std::move(queue_.front());
    queue_.pop_front();
    ++busy_;
    lock.unlock();
    std::exception_ptr error;
    try {
      write_(*result);
    } catch (...) {
      error = std::current_exception();
    }
    result.reset();
    lock.lock();
    --busy_;
    if (error && !error_) error_ = error;
    changed_.notify_all();
  }
}

}  // namespace saccade
