#include "app/interrupt.hpp"

#include <pthread.h>
#include <time.h>

#include <condition_variable>
#include <csignal>
#include <utility>

namespace saccade {

Interrupt::Interrupt() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  struct sigaction hang_up {};
  if (::sigaction(SIGHUP, nullptr, &hang_up) == 0 && hang_up.sa_handler != SIG_IGN)
    sigaddset(&signals_, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  thread_ = std::jthread([this](const std::stop_token& token) { watch(token); });
}

Interrupt::~Interrupt() {
  thread_.request_stop();
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

Interrupt::Handler::Handler(Interrupt& interrupt, std::function<void()> stop) : interrupt_(interrupt) {
  const std::lock_guard lock(interrupt_.mutex_);
  interrupt_.handled_ = true;
  interrupt_.stop_ = std::move(stop);
  if (interrupt_.happened_ && interrupt_.stop_) interrupt_.stop_();
}

Interrupt::Handler::~Handler() {
  const std::lock_guard lock(interrupt_.mutex_);
  interrupt_.stop_ = nullptr;
}

// From now on this thread takes the signals, with their usual effect even if they were ignored.
void Interrupt::let_signals_end_the_program() const {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (sigismember(&signals_, signal) == 1) ::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
}

void Interrupt::watch(const std::stop_token& token) {
  const timespec poll{0, 100'000'000};
  while (!token.stop_requested()) {
    const int signal = sigtimedwait(&signals_, nullptr, &poll);
    if (signal < 0) continue;
    let_signals_end_the_program();
    if (!handled_) ::raise(signal);
    {
      const std::lock_guard lock(mutex_);
      happened_ = true;
      if (stop_) stop_();
    }
    // The thread stays for the second signal, until the destructor restores the signals of the program.
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any().wait(lock, token, [] { return false; });
  }
}

}  // namespace saccade
