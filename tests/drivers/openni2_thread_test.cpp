#include "drivers/openni2/openni2_thread.hpp"

#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace saccade::test {
namespace {

TEST(OpenNi2Thread, OneThreadDoesTheTasksOfAll) {
  std::thread::id first;
  on_openni2_thread([&] { first = std::this_thread::get_id(); });
  EXPECT_NE(first, std::this_thread::get_id());

  int done = 0;  // by one thread only, so that nothing is lost
  bool others = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 500; ++k)
        on_openni2_thread([&] {
          ++done;
          others |= std::this_thread::get_id() != first;
        });
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done, 2000);
  EXPECT_FALSE(others);
}

TEST(OpenNi2Thread, ATaskMayAskForAnother) {
  int value = 0;
  on_openni2_thread([&] { on_openni2_thread([&] { value = 7; }); });
  EXPECT_EQ(value, 7);
}

TEST(OpenNi2Thread, ExceptionsOfATaskAreRethrown) {
  EXPECT_THROW(on_openni2_thread([] { throw std::runtime_error("no"); }), std::runtime_error);
  bool goes_on = false;
  on_openni2_thread([&] { goes_on = true; });
  EXPECT_TRUE(goes_on);
}

}  // namespace
}  // namespace saccade::test
