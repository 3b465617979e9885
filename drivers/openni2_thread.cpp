#include "drivers/openni2_thread.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace saccade {
namespace {

class Worker {
 public:
  Worker() {
    std::thread([this] { work(); }).detach();
  }

  void run(const std::function<void()>& task) {
    if (std::this_thread::get_id() == id_) return task();
    std::packaged_task<void()> packaged(task);
    std::future<void> done = packaged.get_future();
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(packaged));
    }
    changed_.notify_one();
    done.get();
  }

 private:
  [[noreturn]] void work() {
    std::unique_lock lock(mutex_);
    id_ = std::this_thread::get_id();
    for (;;) {
      changed_.wait(lock, [this] { return !tasks_.empty(); });
      std::packaged_task<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> tasks_;  // guarded by mutex_
  std::atomic<std::thread::id> id_;
};

}  // namespace

void on_openni2_thread(const std::function<void()>& task) {
  static Worker& worker = *new Worker;  // its thread outlives every destructor
  worker.run(task);
}

}  // namespace saccade
