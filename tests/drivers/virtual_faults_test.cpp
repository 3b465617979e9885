// The faults of the virtual device that can be ordered, as a program sees them.
#include <map>
#include <thread>

#include "virtual_device_fixture.hpp"

namespace saccade {
namespace {

using openni::STATUS_OK;
using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::IsEmpty;

class VirtualFaultsTest : public VirtualDeviceTest {
 protected:
  static bool can_be_opened() {
    openni::Device again;
    return again.open(kUri) == STATUS_OK;
  }
};

TEST_F(VirtualFaultsTest, LossByEventAndReturn) {
  offer_scene("&loss_after=5&back_after_ms=50");
  DeviceEvents events;
  SeenFrame seen;
  for (int round = 1; round <= 3; ++round) {
    open();
    ASSERT_EQ((*depth_)->start(), STATUS_OK);
    ASSERT_TRUE(depth_->read(seen));
    ASSERT_TRUE(events.wait_for("disconnected", round));
    ASSERT_TRUE(events.wait_for("connected", round));
    close();
  }
}

TEST_F(VirtualFaultsTest, WithoutReturnItCannotBeOpenedAgain) {
  offer_scene("&loss_after=3");
  DeviceEvents events;
  open();
  ASSERT_EQ((*depth_)->start(), STATUS_OK);
  ASSERT_TRUE(events.wait_for("disconnected"));
  EXPECT_THAT(uris(), IsEmpty());
  EXPECT_FALSE(can_be_opened());
}

TEST_F(VirtualFaultsTest, LossByErrorState) {
  offer_scene("&loss_after=3&loss=state&back_after_ms=20");
  DeviceEvents events;
  open();
  ASSERT_EQ((*depth_)->start(), STATUS_OK);
  ASSERT_TRUE(events.wait_for("error"));
  ASSERT_TRUE(events.wait_for("ok"));
  EXPECT_TRUE(events.wait_for("error", 2)) << "frames came again, and then the next loss";
  EXPECT_EQ(events.count("disconnected"), 0);
}

TEST_F(VirtualFaultsTest, SilentLossIsNotReported) {
  offer_scene("&loss_after=3&loss=silent");
  DeviceEvents events;
  open();
  ASSERT_EQ((*depth_)->start(), STATUS_OK);
  int frames = 0;
  SeenFrame seen;
  while (depth_->read(seen, milliseconds(300))) ++frames;
  EXPECT_LE(frames, 3);
  close();
  EXPECT_EQ(events.count("disconnected") + events.count("error"), 0);
  EXPECT_THAT(uris(), Contains(kUri));
  EXPECT_FALSE(can_be_opened()) << "though it is listed";
}

TEST_F(VirtualFaultsTest, ArrivesLate) {
  const auto begin = std::chrono::steady_clock::now();
  offer_scene("&late_ms=800");
  while (uris().empty() && std::chrono::steady_clock::now() < begin + kGenerous)
    std::this_thread::sleep_for(milliseconds(5));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(800));
  EXPECT_TRUE(can_be_opened());
}

TEST_F(VirtualFaultsTest, ShortFramesSayThatTheyAreShort) {
  stream_depth("&short_frame=3");
  SeenFrame seen;
  int shorts = 0;
  while (shorts < 3) {
    ASSERT_TRUE(depth_->read(seen));
    EXPECT_EQ(seen.data_size, seen.index % 3 == 0 ? 160 * 120 : 2 * 160 * 120);
    shorts += seen.image.empty() ? 1 : 0;
  }
}

TEST_F(VirtualFaultsTest, StallsShowInTheTimes) {
  stream_depth("&stall_ms=200&stall_after=4");
  std::map<int, std::uint64_t> times;
  SeenFrame seen;
  while (times.empty() || times.rbegin()->first < 10) {
    ASSERT_TRUE(depth_->read(seen));
    times[seen.index] = seen.timestamp_us;
  }
  for (const auto& [index, time] : times)
    if (index % 4 == 0 && times.contains(index + 1)) {
      EXPECT_GE(times[index + 1] - time, 200'000U);
    }
}

TEST_F(VirtualFaultsTest, SettingsCanSucceedAndDoNothing) {
  open_scene("&ignores_settings=1");
  EXPECT_EQ(device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), STATUS_OK);
  EXPECT_EQ(device_.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  EXPECT_EQ((*depth_)->setMirroringEnabled(true), STATUS_OK);
  EXPECT_FALSE((*depth_)->getMirroringEnabled());
  EXPECT_EQ((*colour_)->getCameraSettings()->setAutoExposureEnabled(false), STATUS_OK);
  EXPECT_TRUE((*colour_)->getCameraSettings()->getAutoExposureEnabled());
}

TEST_F(VirtualFaultsTest, OpenNiCanBeShutDownAndStartedAgainWhileTheDeviceComesAndGoes) {
  for (int cycle = 0; cycle < 3; ++cycle) {
    offer_scene("&loss_after=1&back_after_ms=1");
    DeviceEvents events;
    openni::Device device;
    ASSERT_EQ(device.open(kUri), STATUS_OK);
    SeenStream depth(device, openni::SENSOR_DEPTH);
    ASSERT_EQ(depth->start(), STATUS_OK);
    ASSERT_TRUE(events.wait_for("disconnected"));
    openni::OpenNI::shutdown();  // with the stream and the device open, and the device about to return
  }
}

}  // namespace
}  // namespace saccade
