#include "core/worker_pool.hpp"

#include <sched.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/raise_flag.hpp"

namespace saccade {

WorkerPool::WorkerPool(int workers) {
  if (workers < 1) throw std::invalid_argument("WorkerPool: workers must be at least 1");
  threads_.reserve(static_cast<std::size_t>(workers - 1));
  try {
    for (int worker = 1; worker < workers; ++worker) threads_.emplace_back([this, worker] { work(worker); });
  } catch (...) {  // the system has no more threads: those that there are must end before they are joined
    raise_flag(stop_, mutex_, start_);
    throw;
  }
}

WorkerPool::~WorkerPool() { raise_flag(stop_, mutex_, start_); }

void WorkerPool::for_each(int chunks, const std::function<void(int, int)>& job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    chunks_ = chunks;
    next_.store(0, std::memory_order_relaxed);
    error_ = nullptr;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  start_.notify_all();
  take_chunks(0);
  std::unique_lock lock(mutex_);
  finish_.wait(lock, [this] { return busy_ == 0; });
  job_ = nullptr;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void WorkerPool::work(int worker) {
  std::size_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
    }
    take_chunks(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) finish_.notify_one();
  }
}

void WorkerPool::take_chunks(int worker) noexcept {
  for (;;) {
    const int chunk = next_.fetch_add(1, std::memory_order_relaxed);
    if (chunk >= chunks_) return;
    try {
      if (interrupted_.load(std::memory_order_relaxed)) throw Interrupted();
      (*job_)(chunk, worker);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      next_.store(chunks_, std::memory_order_relaxed);
    }
  }
}

int processor_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace saccade
