#include "app/interrupt.hpp"

#include <pthread.h>
#include <time.h>

#include <utility>

namespace saccade {

Interrupt::Interrupt(std::function<void()> stop) : stop_(std::move(stop)) {
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

void Interrupt::watch(const std::stop_token& token) {
  const timespec poll{0, 100'000'000};
  while (!token.stop_requested()) {
    if (sigtimedwait(&signals_, nullptr, &poll) < 0) continue;
    happened_ = true;
    // From now on this thread takes the signals, with their usual effect.
    pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
    stop_();
    return;
  }
}

}  // namespace saccade
