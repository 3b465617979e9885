#include "core/background_job.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace saccade {
namespace {

TEST(BackgroundJob, RunsOnceForEachStartOnAnotherThread) {
  std::atomic<int> runs = 0;
  std::thread::id thread;
  BackgroundJob job([&] {
    ++runs;
    thread = std::this_thread::get_id();
  });
  job.wait();
  EXPECT_EQ(runs, 0) << "nothing was started";
  for (int i = 1; i <= 100; ++i) {
    job.start();
    job.wait();
    EXPECT_EQ(runs, i);
  }
  EXPECT_NE(thread, std::this_thread::get_id());
}

TEST(BackgroundJob, TheErrorReachesWhoWaits) {
  bool fail = true;
  BackgroundJob job([&] {
    if (fail) throw std::runtime_error("no");
  });
  job.start();
  EXPECT_THROW(job.wait(), std::runtime_error);
  job.wait();
  fail = false;
  job.start();
  EXPECT_NO_THROW(job.wait());
}

TEST(BackgroundJob, EndsAfterTheJobThatRuns) {
  std::atomic<bool> done = false;
  {
    BackgroundJob job([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      done = true;
    });
    job.start();
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace saccade
