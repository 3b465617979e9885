#include "drivers/modules/freenect_loop.hpp"

#include <sys/time.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace saccade {
namespace {

constexpr std::chrono::seconds kCountEvery{1};

std::mutex complaint_mutex;
std::string last_complaint;  // libfreenect gives its messages to a function without a place for an object

void note_complaint(freenect_context*, freenect_loglevel level, const char* message) {
  if (level > FREENECT_LOG_ERROR) return;
  const std::lock_guard lock(complaint_mutex);
  last_complaint = message;
  std::erase(last_complaint, '\n');
}

}  // namespace

std::string FreenectLoop::take_complaint() {
  const std::lock_guard lock(complaint_mutex);
  return std::exchange(last_complaint, {});
}

FreenectLoop::FreenectLoop(std::function<void(int)> on_count, std::function<void()> on_failure)
    : on_count_(std::move(on_count)), on_failure_(std::move(on_failure)) {
  if (freenect_init(&context_, nullptr) < 0)
    throw failed("libfreenect cannot use USB", "Kinect", "is there a USB bus that this user may see?");
  freenect_set_log_level(context_, FREENECT_LOG_ERROR);
  freenect_set_log_callback(context_, note_complaint);
  freenect_select_subdevices(context_,
                             FREENECT_DEVICE_CAMERA);  // the motor and the microphones stay as they are
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

FreenectLoop::~FreenectLoop() {
  thread_.request_stop();
  thread_.join();
  freenect_shutdown(context_);
}

void FreenectLoop::run(const std::function<void(freenect_context*)>& call) {
  std::unique_lock lock(mutex_);
  calls_.push_back(&call);
  changed_.notify_all();
  changed_.wait(lock, [&] { return std::find(calls_.begin(), calls_.end(), &call) == calls_.end(); });
}

void FreenectLoop::set_streaming(const void* device, bool streaming) {
  if (streaming)
    streaming_.insert(device);
  else
    streaming_.erase(device);
}

void FreenectLoop::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    take_calls(lock);
    lock.unlock();
    if (const auto now = std::chrono::steady_clock::now(); now >= next_count_) {
      next_count_ = now + kCountEvery;
      on_count_(freenect_num_devices(context_));
    }
    if (!streaming_.empty()) serve();
    lock.lock();
    if (streaming_.empty()) changed_.wait_until(lock, stop, next_count_, [this] { return !calls_.empty(); });
  }
  take_calls(lock);
}

void FreenectLoop::take_calls(std::unique_lock<std::mutex>& lock) {
  while (!calls_.empty()) {
    const auto* call = calls_.front();
    lock.unlock();
    (*call)(context_);
    lock.lock();
    calls_.erase(calls_.begin());
    changed_.notify_all();
  }
}

void FreenectLoop::serve() {
  timeval patience{0, 20'000};
  if (freenect_process_events_timeout(context_, &patience) >= 0) return;
  streaming_.clear();
  on_failure_();
}

}  // namespace saccade
