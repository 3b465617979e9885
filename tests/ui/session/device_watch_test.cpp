#include "ui/session/device_watch.hpp"

#include <atomic>
#include <semaphore>
#include <stdexcept>

#include <gtest/gtest.h>

namespace saccade {
namespace {

using namespace std::chrono_literals;

constexpr auto kGenerous = 20s;

TEST(DeviceWatch, ReportsArrivalsAndRemovals) {
  std::atomic<int> looks = 0;
  std::counting_semaphore<> changes(0);
  DeviceWatch watch(
      [&]() -> std::vector<DeviceChoice> {
        const int look = ++looks;
        if (look == 1) return {};
        if (look == 2) throw std::runtime_error("no drivers");
        return {{"Virtual", "openni2:virtual/0", ""}};
      },
      [&] { changes.release(); }, 1ms);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(changes.try_acquire_for(kGenerous));
  ASSERT_TRUE(watch.seen().devices.has_value());
  EXPECT_EQ(watch.seen().devices->front().name, "Virtual");
  EXPECT_EQ(watch.seen().error, "");
  EXPECT_FALSE(changes.try_acquire_for(20ms)) << "the same again is no change";
}

TEST(DeviceWatch, EndsWhileItWaits) {
  std::binary_semaphore looked(0);
  DeviceWatch watch([]() -> std::vector<DeviceChoice> { return {}; }, [&] { looked.release(); }, 1h);
  ASSERT_TRUE(looked.try_acquire_for(kGenerous));
}

}  // namespace
}  // namespace saccade
