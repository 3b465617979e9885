#include "oni/recorder.hpp"

#include <stdexcept>
#include <utility>

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kLongestUnsynced{1};

}  // namespace

OniRecorder::OniRecorder(OniWriter& writer, std::size_t capacity) : writer_(writer), capacity_(capacity) {
  if (capacity < 1) throw std::invalid_argument("OniRecorder: the queue needs room for one frame");
  thread_ = std::jthread([this] { work(); });
}

OniRecorder::~OniRecorder() {
  const std::lock_guard lock(mutex_);
  finishing_ = true;
  abandoned_ = true;
  changed_.notify_all();
}

bool OniRecorder::offer(const Frame& frame) {
  std::unique_lock lock(mutex_);
  rethrow();
  if (queue_.size() >= capacity_) {
    ++dropped_;
    return false;
  }
  add(lock, frame);
  return true;
}

void OniRecorder::push(const Frame& frame) {
  std::unique_lock lock(mutex_);
  source_waits_ = true;
  changed_.wait(lock, [this] { return error_ || queue_.size() < capacity_; });
  rethrow();
  add(lock, frame);
}

// Copies the frame without the lock: only one thread adds frames.
void OniRecorder::add(std::unique_lock<std::mutex>& lock, const Frame& frame) {
  Frame copy;
  if (!recycled_.empty()) {
    copy = std::move(recycled_.front());
    recycled_.pop_front();
  }
  lock.unlock();
  cv::Mat1f depth = std::move(copy.depth_mm);
  cv::Mat3b colour = std::move(copy.colour);
  frame.depth_mm.copyTo(depth);
  frame.colour.copyTo(colour);
  copy = frame;
  copy.depth_mm = std::move(depth);
  copy.colour = std::move(colour);
  copy.truth = {};
  lock.lock();
  queue_.push_back(std::move(copy));
  changed_.notify_all();
}

void OniRecorder::rethrow() {
  if (error_) std::rethrow_exception(error_);
}

void OniRecorder::finish() {
  {
    const std::lock_guard lock(mutex_);
    finishing_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  rethrow();
}

OniWriterCounts OniRecorder::counts() const {
  const std::lock_guard lock(mutex_);
  OniWriterCounts counts = counts_;
  counts.dropped = dropped_;
  return counts;
}

std::uint64_t OniRecorder::size_bytes() const {
  const std::lock_guard lock(mutex_);
  return size_bytes_;
}

// Queued frames of a camera are written before the next sync: one sync for all takes no longer than for one.
bool OniRecorder::time_to_sync(Clock::time_point last) const {
  return queue_.empty() || source_waits_ || Clock::now() - last >= kLongestUnsynced;
}

void OniRecorder::work() {
  std::unique_lock lock(mutex_);
  Clock::time_point last_sync = Clock::now();
  try {
    for (;;) {
      changed_.wait(lock, [this] { return finishing_ || !queue_.empty(); });
      if (abandoned_ || queue_.empty()) break;
      Frame frame = std::move(queue_.front());
      queue_.pop_front();
      const std::uint64_t dropped = dropped_;
      changed_.notify_all();
      lock.unlock();
      writer_.note_dropped(dropped);
      writer_.write(frame);
      lock.lock();
      counts_ = writer_.counts();
      size_bytes_ = writer_.size_bytes();
      recycled_.push_back(std::move(frame));
      if (!time_to_sync(last_sync)) continue;
      lock.unlock();
      writer_.sync();
      last_sync = Clock::now();
      lock.lock();
      counts_ = writer_.counts();
    }
    const std::uint64_t dropped = dropped_;
    lock.unlock();
    writer_.note_dropped(dropped);
    writer_.close();
    lock.lock();
  } catch (...) {
    const std::exception_ptr error = std::current_exception();
    // The first error is reported; a second one while closing is not.
    try {
      writer_.close();
    } catch (const std::exception&) {
    }
    if (!lock.owns_lock()) lock.lock();
    error_ = error;
  }
  counts_ = writer_.counts();
  size_bytes_ = writer_.size_bytes();
  changed_.notify_all();
}

}  // namespace saccade
