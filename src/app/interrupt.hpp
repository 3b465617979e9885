#pragma once

#include <signal.h>

#include <atomic>
#include <functional>
#include <thread>

namespace saccade {

/// While it lives, Ctrl-C and SIGTERM call `stop` (once, on a thread of its own) instead of ending the
/// program; a second signal ends it as usual. Make it before any other thread, so that they inherit the
/// blocked signals.
class Interrupt {
 public:
  explicit Interrupt(std::function<void()> stop);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool happened() const { return happened_; }

 private:
  void watch(const std::stop_token& token);

  std::function<void()> stop_;
  std::atomic<bool> happened_ = false;
  sigset_t signals_{}, before_{};
  std::jthread thread_;
};

}  // namespace saccade
