#pragma once

#include <signal.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace saccade {

/// While it lives, Ctrl-C and SIGTERM are remembered and stop what a Handler names, instead of ending the
/// program; a second signal ends it as usual. Make it before any other thread, so that they inherit the
/// blocked signals.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Any thread.
  bool happened() const { return happened_; }

  /// While it lives, the first signal calls `stop`: on a thread of the Interrupt, or at once in the
  /// constructor if the signal has come already. One at a time per Interrupt, which must outlive it.
  class Handler {
   public:
    Handler(Interrupt& interrupt, std::function<void()> stop);
    ~Handler();
    Handler(const Handler&) = delete;
    Handler& operator=(const Handler&) = delete;

   private:
    Interrupt& interrupt_;
  };

 private:
  void watch(const std::stop_token& token);

  std::atomic<bool> happened_ = false;
  std::mutex mutex_;
  std::function<void()> stop_;  // of the Handler that lives; guarded by mutex_
  sigset_t signals_{}, before_{};
  std::jthread thread_;
};

}  // namespace saccade
