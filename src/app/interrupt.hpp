#pragma once

#include <signal.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace saccade {

/// Ctrl-C, SIGTERM and SIGHUP (a closed terminal; not if it is ignored, as by nohup). Until the first Handler
/// is made they end the program, as usual: nothing is written yet, and the program may be waiting for a file
/// or a driver. From then on, as long as this lives, the first signal is remembered and stops what the
/// Handler names; a second one ends the program at once, also where it hangs. Make it before any other
/// thread, so that they inherit the blocked signals.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Any thread.
  bool happened() const { return happened_; }

  /// While it lives, the first signal calls `stop`, which may be empty: on a thread of the Interrupt, or at
  /// once in the constructor if the signal has come already. One at a time per Interrupt, which must outlive
  /// it.
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
  void let_signals_end_the_program() const;

  std::atomic<bool> happened_ = false, handled_ = false;  // handled_: there has been a Handler
  std::mutex mutex_;
  std::function<void()> stop_;  // of the Handler that lives; guarded by mutex_
  sigset_t signals_{}, before_{};
  std::jthread thread_;
};

}  // namespace saccade
