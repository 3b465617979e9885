#include "drivers/modules/announcer.hpp"

#include <pthread.h>

#include <utility>

namespace saccade {
namespace {

// Longer than a program takes to handle the report of a device.
constexpr std::chrono::milliseconds kStuck{500};

}  // namespace

Announcer::Announcer() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Announcer::stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, kStuck, [this] { return ended_; }))
      ::pthread_cancel(thread_.native_handle());
  }
  thread_.join();
}

void Announcer::at(Clock::time_point due, std::function<void()> action) {
  {
    const std::lock_guard lock(mutex_);
    actions_.emplace(due, std::move(action));
  }
  changed_.notify_one();
}

[[gnu::no_sanitize_address]] void Announcer::run(const std::stop_token& stop) {
  int before = 0;
  ::pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before);
  take_actions(stop);
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void Announcer::call(const std::function<void()>& action) {
  int before = 0;
  // An action that hangs may never come to a point where it could be cancelled.
  // NOLINTNEXTLINE(concurrency-thread-canceltype-asynchronous)
  ::pthread_setcanceltype(PTHREAD_CANCEL_ASYNCHRONOUS, &before);
  ::pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, &before);
  action();
  ::pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before);
}

// A cancelled thread leaves the stack frames below without running their ends, and AddressSanitizer finds
// their guards when it works for this function, which the same unwinding leaves.
[[gnu::no_sanitize_address]] void Announcer::take_actions(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !actions_.empty(); })) {
    const Clock::time_point due = actions_.begin()->first;
    if (Clock::now() < due) {
      changed_.wait_until(lock, stop, due, [&] { return actions_.begin()->first < due; });
      if (stop.stop_requested()) return;
      continue;
    }
    const std::function<void()> action = std::move(actions_.extract(actions_.begin()).mapped());
    lock.unlock();
    call(action);
    lock.lock();
    if (stop.stop_requested()) return;
  }
}

}  // namespace saccade
