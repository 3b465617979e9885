#include "ui/session/device_watch.hpp"

#include <exception>
#include <utility>

namespace saccade {

DeviceWatch::DeviceWatch(List list, std::function<void()> changed, std::chrono::milliseconds period)
    : list_(std::move(list)),
      changed_(std::move(changed)),
      period_(period),
      thread_([this](const std::stop_token& token) { work(token); }) {}

DeviceWatch::~DeviceWatch() = default;  // stops and joins the thread

DeviceWatch::Seen DeviceWatch::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

DeviceWatch::Seen DeviceWatch::look() const {
  Seen seen;
  try {
    seen.devices = list_();
  } catch (const std::exception& error) {
    seen.error = error.what();
  }
  return seen;
}

void DeviceWatch::work(const std::stop_token& token) {
  std::unique_lock lock(mutex_);
  while (!token.stop_requested()) {
    lock.unlock();
    Seen seen = look();
    lock.lock();
    if (seen_ != seen) {
      seen_ = std::move(seen);
      lock.unlock();
      changed_();
      lock.lock();
    }
    wake_.wait_for(lock, token, period_, [] { return false; });
  }
}

}  // namespace saccade
