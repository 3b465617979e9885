#pragma once

#include <libfreenect.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace saccade {

/// libfreenect, and the one thread that calls it: others send their calls here. This thread also hands frames
/// on and counts devices.
class FreenectLoop {
 public:
  /// Starts. `on_count` receives the number of Kinects every second; `on_failure` is called when the streams
  /// end because one was unplugged. Throws Error (failed) without USB.
  FreenectLoop(std::function<void(int)> on_count, std::function<void()> on_failure);
  ~FreenectLoop();
  FreenectLoop(const FreenectLoop&) = delete;
  FreenectLoop& operator=(const FreenectLoop&) = delete;

  /// Runs `call` on the thread and waits for it. Any other thread.
  void run(const std::function<void(freenect_context*)>& call);

  /// Whether `device` has streams to serve; only inside run().
  void set_streaming(const void* device, bool streaming);

  /// The last message of libfreenect, which is then forgotten; may be empty.
  static std::string take_complaint();

 private:
  void work(const std::stop_token& stop);
  void take_calls(std::unique_lock<std::mutex>& lock);
  void serve();

  freenect_context* context_ = nullptr;
  const std::function<void(int)> on_count_;
  const std::function<void()> on_failure_;
  std::set<const void*> streaming_;  // the thread's own
  std::chrono::steady_clock::time_point next_count_{};
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<const std::function<void(freenect_context*)>*> calls_;  // guarded by mutex_
  std::jthread thread_;
};

}  // namespace saccade
