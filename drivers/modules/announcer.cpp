#include "drivers/modules/announcer.hpp"

#include <utility>

namespace saccade {

Announcer::Announcer() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

Announcer::~Announcer() {
  thread_.request_stop();
  thread_.join();
}

void Announcer::at(Clock::time_point due, std::function<void()> action) {
  {
    const std::lock_guard lock(mutex_);
    actions_.emplace(due, std::move(action));
  }
  changed_.notify_one();
}

void Announcer::run(const std::stop_token& stop) {
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
    action();
    lock.lock();
    if (stop.stop_requested()) return;
  }
}

}  // namespace saccade
