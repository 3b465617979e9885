#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

namespace saccade {

/// Runs actions on a thread of its own, each at its time. From here a driver module reports to OpenNI2 that
/// devices come and go, because a program may stop and close the device from inside the call.
class Announcer {
 public:
  using Clock = std::chrono::steady_clock;

  Announcer();
  ~Announcer() { stop(); }
  Announcer(const Announcer&) = delete;
  Announcer& operator=(const Announcer&) = delete;

  /// Waits for the action that runs; drops those that wait for their time and those that come later. OpenNI2
  /// holds its lock while it shuts its drivers down, and takes the same lock when a device is reported: an
  /// action that waits for that lock would never end, so after a while it is cancelled where it waits. Not
  /// from inside an action.
  void stop();

  /// Any thread, actions too.
  void at(Clock::time_point due, std::function<void()> action);
  void now(std::function<void()> action) { at(Clock::now(), std::move(action)); }

 private:
  void run(const std::stop_token& stop);
  void take_actions(const std::stop_token& stop);
  static void call(const std::function<void()>& action);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::multimap<Clock::time_point, std::function<void()>> actions_;  // guarded by mutex_
  bool ended_ = false;                                               // guarded by mutex_
  std::jthread thread_;
};

}  // namespace saccade
