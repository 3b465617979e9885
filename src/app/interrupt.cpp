#include "app/interrupt.hpp"

#include <pthread.h>
#include <time.h>

#include <utility>

namespace saccade {

Interrupt::Interrupt() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
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
  interrupt_.stop_ = std::move(stop);
  if (interrupt_.happened_) interrupt_.stop_();
}

Interrupt::Handler::~Handler() {
  const std::lock_guard lock(interrupt_.mutex_);
  interrupt_.stop_ = nullptr;
}

void Interrupt::watch(const std::stop_token& token) {
  const timespec poll{0, 100'000'000};
  while (!token.stop_requested()) {
    if (sigtimedwait(&signals_, nullptr, &poll) < 0) continue;
    // From now on this thread takes the signals, with their usual effect.
    pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
    const std::lock_guard lock(mutex_);
    happened_ = true;
    if (stop_) stop_();
    return;
  }
}

}  // namespace saccade
