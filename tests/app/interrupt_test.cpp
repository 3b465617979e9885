#include "app/interrupt.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>

#include <gtest/gtest.h>

namespace saccade {
namespace {

bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return condition();
}

TEST(Interrupt, ASignalCallsTheHandlerThatLives) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Interrupt interrupt;
    EXPECT_FALSE(interrupt.happened());
    std::atomic<int> gone = 0, calls = 0;
    {
      const Interrupt::Handler handler(interrupt, [&] { ++gone; });
    }
    const Interrupt::Handler handler(interrupt, [&] { ++calls; });
    ::kill(::getpid(), signal);
    EXPECT_TRUE(comes_true([&] { return calls == 1; }));
    EXPECT_TRUE(interrupt.happened());
    EXPECT_EQ(gone, 0);
  }
}

TEST(Interrupt, AHandlerThatComesAfterTheSignalIsCalledAtOnce) {
  Interrupt interrupt;
  ::kill(::getpid(), SIGINT);
  ASSERT_TRUE(comes_true([&] { return interrupt.happened(); }));
  int calls = 0;
  const Interrupt::Handler handler(interrupt, [&] { ++calls; });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace saccade
