#include "app/interrupt.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

namespace saccade {
namespace {

bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return condition();
}

// The signal that ends a child process which runs `work`; 0 if it exits.
int signal_that_ends(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

TEST(Interrupt, ASignalCallsTheHandlerThatLives) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
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
  { const Interrupt::Handler handler(interrupt, {}); }
  ::kill(::getpid(), SIGINT);
  ASSERT_TRUE(comes_true([&] { return interrupt.happened(); }));
  int calls = 0;
  const Interrupt::Handler handler(interrupt, [&] { ++calls; });
  EXPECT_EQ(calls, 1);
}

TEST(Interrupt, BeforeTheFirstHandlerASignalEndsTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EQ(signal_that_ends([signal] {
                const Interrupt interrupt;
                ::kill(::getpid(), signal);
                std::this_thread::sleep_for(std::chrono::seconds(20));
              }),
              signal);
}

TEST(Interrupt, ASecondSignalEndsTheProgramWhereverItHangs) {
  EXPECT_EQ(signal_that_ends([] {
              Interrupt interrupt;
              const Interrupt::Handler handler(interrupt, {});
              ::kill(::getpid(), SIGINT);
              while (!interrupt.happened()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
              ::kill(::getpid(), SIGTERM);
              std::this_thread::sleep_for(std::chrono::seconds(20));
            }),
            SIGTERM);
  EXPECT_EQ(signal_that_ends([] {
              Interrupt interrupt;
              std::atomic<bool> hangs = false;
              const Interrupt::Handler handler(interrupt, [&] {  // as in a driver
                hangs = true;
                std::this_thread::sleep_for(std::chrono::seconds(20));
              });
              ::kill(::getpid(), SIGINT);
              while (!hangs) std::this_thread::sleep_for(std::chrono::milliseconds(1));
              ::kill(::getpid(), SIGINT);
              std::this_thread::sleep_for(std::chrono::seconds(20));
            }),
            SIGINT);
}

TEST(Interrupt, AnIgnoredHangUpStaysIgnored) {
  EXPECT_EQ(signal_that_ends([] {
              std::signal(SIGHUP, SIG_IGN);
              Interrupt interrupt;
              const Interrupt::Handler handler(interrupt, {});
              ::kill(::getpid(), SIGHUP);
              std::this_thread::sleep_for(std::chrono::milliseconds(300));
              if (interrupt.happened()) ::abort();
            }),
            0);
}

}  // namespace
}  // namespace saccade
