#include "drivers/openni2/openni2_thread.hpp"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace saccade {
namespace {

// Lives on the stack of the thread that waits for it.
struct Job {
  void (*call)(void* task);
  void* task;
  Job* next = nullptr;
  bool done = false;
  std::exception_ptr error{};
};

class Worker {
 public:
  Worker() {
    std::thread([this] { work(); }).detach();
  }

  void run(Job job) {
    if (std::this_thread::get_id() == id_) return job.call(job.task);
    std::unique_lock lock(mutex_);
    (last_ == nullptr ? first_ : last_->next) = &job;
    last_ = &job;
    came_.notify_one();
    done_.wait(lock, [&job] { return job.done; });
    if (job.error) std::rethrow_exception(job.error);
  }

 private:
  [[noreturn]] void work() {
    std::unique_lock lock(mutex_);
    id_ = std::this_thread::get_id();
    for (;;) {
      came_.wait(lock, [this] { return first_ != nullptr; });
      Job& job = *std::exchange(first_, first_->next);
      if (first_ == nullptr) last_ = nullptr;
      lock.unlock();
      try {
        job.call(job.task);
      } catch (...) {
        job.error = std::current_exception();
      }
      lock.lock();
      job.done = true;  // after this it is gone as soon as the lock is free
      done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable came_, done_;
  Job *first_ = nullptr, *last_ = nullptr;  // the queue; guarded by mutex_, as is Job::done
  std::atomic<std::thread::id> id_;
};

}  // namespace

void run_on_openni2_thread(void (*call)(void* task), void* task) {
  static Worker& worker = *new Worker;  // its thread outlives every destructor
  worker.run({.call = call, .task = task});
}

}  // namespace saccade
