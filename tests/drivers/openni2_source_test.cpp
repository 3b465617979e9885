// The live source on the virtual device, in this process: what it gives, its controls, and its end. Losses
// and other faults are ordered for a whole process, so tests/app/live_test.cpp has them.
#include "drivers/openni2/openni2_source.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "drivers/openni2/openni2_devices.hpp"
#include "drivers/openni2/openni2_modes.hpp"
#include "sources/open_source.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {
namespace {

using std::chrono::milliseconds;

constexpr int kScenes = 5;
const std::string kScene = "synthetic:table?size=160x120&noise=kinect&frames=5&scenes=5";

// OpenNI2 reads it when it starts, which is with the first device that a test wants.
class Sensor : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { ::setenv("SACCADE_VIRTUAL_DEVICE", kScene.c_str(), 1); }

  // The next frame; the device is given as long as it takes.
  static Frame next(FrameSource& source) {
    Frame frame;
    ReadResult read{ReadStatus::timeout, ""};
    while (read.status == ReadStatus::timeout) read = source.read(frame, milliseconds(100));
    EXPECT_EQ(read.status, ReadStatus::frame) << read.reason;
    return frame;
  }

  // All frames of the scene, in integer millimetres as the device gives them.
  static std::vector<Frame> originals() {
    const auto source = open_source(kScene);
    std::vector<Frame> frames(kScenes);
    for (Frame& frame : frames) EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    return frames;
  }

  static bool same(const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
  }
};

TEST_F(Sensor, GivesTheFramesOfTheDeviceWithTheirColour) {
  const auto source = open_source("openni2");
  EXPECT_TRUE(source->info().live);
  EXPECT_EQ(source->info().size, cv::Size(160, 120));
  const auto expected = originals();
  std::set<std::size_t> seen;
  std::int64_t last_index = -1, last_us = -1;
  while (seen.size() < kScenes) {
    const Frame frame = next(*source);
    EXPECT_EQ(frame.index, last_index + 1);
    EXPECT_GT(frame.timestamp_us, last_us);
    last_index = frame.index;
    last_us = frame.timestamp_us;
    std::size_t which = 0;
    while (which < kScenes && !same(frame.depth_mm, expected[which].depth_mm)) ++which;
    ASSERT_LT(which, kScenes) << "no frame of the scene";
    if (frame.colour.empty()) continue;  // a machine that is busy may miss it
    EXPECT_TRUE(same(frame.colour, expected[which].colour)) << "colour of another moment";
    seen.insert(which);
  }
  EXPECT_EQ(source->state().connection, SourceState::Connection::streaming);
  EXPECT_EQ(source->state().losses, 0);
}

TEST_F(Sensor, IntrinsicsComeFromTheFieldOfView) {
  const auto source = open_source("openni2");
  const Intrinsics is = next(*source).intrinsics, expected = open_source(kScene)->info().intrinsics;
  EXPECT_EQ(is.origin, IntrinsicsOrigin::sensor);
  EXPECT_NEAR(is.fx, expected.fx, 1e-4);
  EXPECT_NEAR(is.fy, expected.fy, 1e-4);
  EXPECT_EQ(is.cx, 79.5);
  EXPECT_EQ(source->info().intrinsics.fx, is.fx);
}

TEST_F(Sensor, TakesTheModeThatIsAskedForOrNone) {
  SensorSettings settings;
  settings.mode = SensorMode{80, 60, 60};
  const auto source = open_source("openni2:saccade-virtual://0", {settings});
  EXPECT_EQ(source->info().rate_hz, 60);
  Frame frame = next(*source);
  EXPECT_EQ(frame.size(), cv::Size(80, 60));
  while (frame.colour.empty()) frame = next(*source);  // a machine that is busy may miss one
  EXPECT_EQ(frame.colour.size(), cv::Size(80, 60));
  settings.mode = SensorMode{81, 60, 60};
  try {
    open_source("openni2", {settings});
    ADD_FAILURE() << "there is no such mode";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
    EXPECT_NE(std::string(error.what()).find("80x60@60"), std::string::npos) << "names what there is";
  }
}

TEST_F(Sensor, ControlsAreReadBackAndHoldForTheFrames) {
  const auto source = open_source("openni2");
  SensorControls& controls = *source->controls();
  next(*source);
  EXPECT_EQ(controls.values().registration, true) << "the default";
  EXPECT_EQ(controls.values().mirror, false);
  EXPECT_EQ(controls.values().auto_exposure, true);
  EXPECT_EQ(controls.values().auto_white_balance, true);
  SensorValues wanted;
  wanted.mirror = true;
  wanted.auto_exposure = false;
  wanted.exposure = 20;
  wanted.auto_white_balance = false;
  controls.request(wanted);
  for (int i = 0; i < 4; ++i) next(*source);  // those that were under way
  const SensorValues is = controls.values();
  EXPECT_EQ(is.mirror, true);
  EXPECT_EQ(is.auto_exposure, false);
  EXPECT_EQ(is.exposure, 20);
  EXPECT_EQ(is.auto_white_balance, false);
  EXPECT_EQ(is.registration, true) << "untouched";
  const Frame mirrored = next(*source);
  bool found = false;
  for (const Frame& frame : originals()) {
    cv::Mat flipped;
    cv::flip(frame.depth_mm, flipped, 1);
    found = found || same(flipped, mirrored.depth_mm);
  }
  EXPECT_TRUE(found);
}

TEST_F(Sensor, EachListedModeCanBeOpened) {
  const std::vector<SensorMode> modes = open_source("openni2")->controls()->modes();
  EXPECT_EQ(modes, (std::vector<SensorMode>{{160, 120, 30}, {160, 120, 60}, {80, 60, 30}, {80, 60, 60}}));
  for (const SensorMode& mode : modes) {
    SensorSettings settings;
    settings.mode = mode;
    const auto source = open_source("openni2", {settings});
    EXPECT_EQ(source->info().size, cv::Size(mode.width, mode.height));
    EXPECT_EQ(source->info().rate_hz, mode.rate_hz);
  }
}

TEST_F(Sensor, DevicesAreListedWhileOneStreams) {
  const auto source = open_source("openni2");
  for (int i = 0; i < 20; ++i) {
    const auto devices = list_devices();
    ASSERT_EQ(devices.size(), 1U);
    EXPECT_EQ(devices[0].source, "openni2:saccade-virtual://0");
    EXPECT_EQ(devices[0].driver, "SaccadeVirtual");
    next(*source);
  }
}

TEST_F(Sensor, LookingIntoADeviceGivesItsModes) {
  DeviceListing device = list_devices().at(0);
  look_into(device);
  EXPECT_EQ(device.problem, "");
  EXPECT_EQ(device.serial, "VIRTUAL-1");
  EXPECT_EQ(device.depth_modes, open_source("openni2")->controls()->modes());
  EXPECT_EQ(device.colour_modes.size(), 4U);
  device.identity.uri = "absent://1";
  look_into(device);
  EXPECT_TRUE(device.problem.starts_with("it cannot be opened: ")) << device.problem;
  EXPECT_EQ(device.problem.find('\n'), std::string::npos) << device.problem;
}

TEST_F(Sensor, OneThatIsNotThereIsAnErrorOrIsWaitedFor) {
  SensorSettings settings;
  settings.wait_s = 0;
  try {
    open_source("openni2:absent://1", {settings});
    ADD_FAILURE() << "it is not there";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::unreadable);
  }
  settings.wait_s = 1000;
  const auto source = open_source("openni2:absent://1", {settings});
  EXPECT_EQ(source->state().connection, SourceState::Connection::waiting);
  EXPECT_TRUE(source->controls()->modes().empty());
  Frame frame;
  EXPECT_EQ(source->read(frame, milliseconds(1)).status, ReadStatus::timeout);
  source->interrupt();
  EXPECT_EQ(source->read(frame, std::chrono::hours(1)).status, ReadStatus::timeout);
  std::jthread other([&] { source->interrupt(); });
  EXPECT_EQ(source->read(frame, std::chrono::hours(1)).status, ReadStatus::timeout);
}

TEST_F(Sensor, CannotBeRewound) { EXPECT_THROW(open_source("openni2")->seek(0), std::logic_error); }

// As in the viewer: each opening is read by a thread of its own, which ends with it.
TEST_F(Sensor, CanBeReadByOneThreadAfterAnother) {
  for (int opening = 0; opening < 3; ++opening) {
    std::thread([] { next(*open_source("openni2")); }).join();
    // The memory of a thread that has ended is kept for the next ones; these make it go.
    std::vector<std::jthread> others(10);
    for (std::jthread& other : others)
      other = std::jthread([] { std::this_thread::sleep_for(milliseconds(20)); });
  }
}

TEST_F(Sensor, OpensAndClosesAtAnyMoment) {
  std::minstd_rand dice(7);
  SensorSettings settings;
  settings.mode = SensorMode{160, 120, 60};
  for (int i = 0; i < 40; ++i) {
    const auto source = open_source("openni2", {settings});
    for (auto frames = dice() % 4; frames > 0; --frames) next(*source);
    std::this_thread::sleep_for(std::chrono::microseconds(dice() % 12000));
  }
}

TEST(ChooseDevice, FindsTheOneThatIsMeant) {
  const DeviceIdentity xtion{"1d27/0600@1/7", "ASUS", "Xtion", 0x1d27, 0x0600},
      moved{"1d27/0600@1/9", "ASUS", "Xtion", 0x1d27, 0x0600},
      kinect{"freenect://0", "Microsoft", "Kinect", 0, 0};
  const auto none = std::nullopt;
  EXPECT_EQ(choose_device({}, "", none), -1);
  EXPECT_EQ(choose_device({kinect, xtion}, "", none), 0) << "the first";
  EXPECT_EQ(choose_device({kinect, xtion}, xtion.uri, none), 1);
  EXPECT_EQ(choose_device({kinect}, xtion.uri, none), -1);
  EXPECT_EQ(choose_device({kinect, xtion}, "", xtion), 1) << "the one it had";
  EXPECT_EQ(choose_device({kinect, moved}, xtion.uri, xtion), 1) << "plugged in again elsewhere";
  EXPECT_EQ(choose_device({kinect}, xtion.uri, xtion), -1) << "another kind is another device";
  EXPECT_EQ(choose_device({moved, {"1d27/0600@1/10", "ASUS", "Xtion", 0x1d27, 0x0600}}, xtion.uri, xtion), -1)
      << "which of two?";
}

TEST(NearestMode, SizeComesBeforeRate) {
  const std::vector<SensorMode> offered = {{320, 240, 30}, {640, 480, 25}, {640, 480, 60}, {1280, 1024, 30}};
  EXPECT_EQ(nearest_mode(offered, {640, 480, 30}), 1);
  EXPECT_EQ(nearest_mode(offered, {320, 240, 60}), 0);
  EXPECT_EQ(nearest_mode({}, {640, 480, 30}), -1);
}

}  // namespace
}  // namespace saccade
