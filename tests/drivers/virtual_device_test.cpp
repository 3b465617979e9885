// The virtual device, through OpenNI2 as any program would use it.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include <gmock/gmock.h>

#include "drivers/open_source.hpp"
#include "openni_device.hpp"

namespace saccade {
namespace {

using openni::Device;
using openni::SENSOR_COLOR;
using openni::SENSOR_DEPTH;
using openni::STATUS_OK;
using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kScene = "synthetic:table?seed=3&noise=kinect&size=160x120&frames=7";

class VirtualDeviceTest : public OpenNiTest {
 protected:
  ~VirtualDeviceTest() override { ::unsetenv("SACCADE_VIRTUAL_DEVICE"); }

  static void offer(const std::string& text) {
    ::setenv("SACCADE_VIRTUAL_DEVICE", text.c_str(), 1);
    start();
  }
  static void offer_scene(const std::string& faults) { offer(std::string(kScene) + "&rate=200" + faults); }
  static void open(Device& device) {
    ASSERT_EQ(device.open(openni::ANY_DEVICE), STATUS_OK) << openni::OpenNI::getExtendedError();
  }

  // The frames of the scene, as the device should give them.
  static std::vector<Frame> expected() {
    std::vector<Frame> frames;
    const auto source = open_source(kScene);
    Frame frame;
    while (source->read(frame, milliseconds(0)).status == ReadStatus::frame) {
      frames.push_back(frame);
      frames.back().depth_mm = frame.depth_mm.clone();
    }
    return frames;
  }

  // Reads until a frame comes or the time is over.
  static bool frames_come(SeenStream& stream, milliseconds timeout = kGenerous) {
    SeenFrame frame;
    return stream.read(frame, timeout);
  }
};

bool equal(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const cv::Mat joined_a = a.isContinuous() ? a : a.clone(), joined_b = b.isContinuous() ? b : b.clone();
  return std::memcmp(joined_a.data, joined_b.data, joined_a.total() * joined_a.elemSize()) == 0;
}

// What the device should give of a frame, by the plainest code.
cv::Mat1w depth_of(const Frame& frame, int step = 1) {
  cv::Mat1w depth(frame.size() / step);
  for (int row = 0; row < depth.rows; ++row)
    for (int column = 0; column < depth.cols; ++column)
      depth(row, column) = static_cast<std::uint16_t>(std::lround(frame.depth_mm(step * row, step * column)));
  return depth;
}

cv::Mat3b colour_of(const Frame& frame, int step = 1) {
  cv::Mat3b rgb(frame.size() / step);
  for (int row = 0; row < rgb.rows; ++row)
    for (int column = 0; column < rgb.cols; ++column) {
      const cv::Vec3b bgr = frame.colour(step * row, step * column);
      rgb(row, column) = {bgr[2], bgr[1], bgr[0]};
    }
  return rgb;
}

TEST_F(VirtualDeviceTest, IsListedOnlyWhenAskedFor) {
  start();
  EXPECT_THAT(uris(), Not(::testing::Contains(HasSubstr("saccade"))));
  openni::OpenNI::shutdown();
  offer(kScene);
  EXPECT_THAT(uris(), ::testing::Contains("saccade-virtual://0"));
}

TEST_F(VirtualDeviceTest, WhatCannotBePlayedIsToldInOneLineAndNotListed) {
  for (const char* text : {"/no/such/folder", "synthetic:table?sead=3", "synthetic:table?loss=lost",
                           "openni2", SACCADE_SOURCE_DIR "/README.md"}) {
    ::testing::internal::CaptureStderr();
    offer(text);
    const std::string err = ::testing::internal::GetCapturedStderr();
    EXPECT_THAT(uris(), IsEmpty());
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_THAT(err, HasSubstr("SACCADE_VIRTUAL_DEVICE"));
    openni::OpenNI::shutdown();
  }
}

TEST_F(VirtualDeviceTest, ARelativePathIsSeenFromTheFolderThatTheShellTells) {
  const char* pwd = std::getenv("PWD");
  const std::optional<std::string> before = pwd != nullptr ? std::optional<std::string>(pwd) : std::nullopt;
  ::setenv("PWD", SACCADE_SOURCE_DIR, 1);
  offer("recordings/table.oni");
  EXPECT_THAT(uris(), ::testing::Contains("saccade-virtual://0"));
  if (before)
    ::setenv("PWD", before->c_str(), 1);
  else
    ::unsetenv("PWD");
}

TEST_F(VirtualDeviceTest, GivesTheFramesOfTheSourceWithDepthAndColourOfOneMoment) {
  const std::vector<Frame> frames = expected();
  ASSERT_EQ(frames.size(), 7U);
  offer_scene("");
  Device device;
  open(device);
  std::map<int, std::uint64_t> times;
  std::size_t pairs = 0;
  SeenStream depth(device, SENSOR_DEPTH), colour(device, SENSOR_COLOR);
  ASSERT_EQ(depth->start(), STATUS_OK);
  ASSERT_EQ(colour->start(), STATUS_OK);
  SeenFrame seen;
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(depth.read(seen));
    EXPECT_TRUE(equal(seen.image, depth_of(frames[static_cast<std::size_t>(seen.index - 1) % 7])))
        << seen.index;
    pairs += times.contains(seen.index) ? 1U : 0U;
    EXPECT_EQ(times.emplace(seen.index, seen.timestamp_us).first->second, seen.timestamp_us);
    ASSERT_TRUE(colour.read(seen));
    EXPECT_TRUE(equal(seen.image, colour_of(frames[static_cast<std::size_t>(seen.index - 1) % 7])))
        << seen.index;
    pairs += times.contains(seen.index) ? 1U : 0U;
    EXPECT_EQ(times.emplace(seen.index, seen.timestamp_us).first->second, seen.timestamp_us);
  }
  EXPECT_GT(pairs, 0U);
  for (auto now = std::next(times.begin()); now != times.end(); ++now)
    EXPECT_GT(now->second, std::prev(now)->second);
}

TEST_F(VirtualDeviceTest, AnswersWhatProgramsAsk) {
  offer_scene("");
  Device device;
  open(device);
  EXPECT_STREQ(device.getDeviceInfo().getName(), "Virtual device");
  EXPECT_STREQ(device.getDeviceInfo().getVendor(), "Saccade");
  char serial[64] = {};
  int size = sizeof serial;
  EXPECT_EQ(device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size), STATUS_OK);
  EXPECT_STREQ(serial, "VIRTUAL-1");
  size = 3;  // too small
  EXPECT_NE(device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size), STATUS_OK);

  EXPECT_EQ(device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  EXPECT_TRUE(device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  EXPECT_EQ(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), STATUS_OK);
  EXPECT_EQ(device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  EXPECT_EQ(device.setDepthColorSyncEnabled(true), STATUS_OK);

  SeenStream depth(device, SENSOR_DEPTH), colour(device, SENSOR_COLOR);
  const Intrinsics camera = open_source(kScene)->info().intrinsics;
  EXPECT_NEAR(80 / std::tan(depth->getHorizontalFieldOfView() / 2), camera.fx, 1e-4);
  EXPECT_NEAR(60 / std::tan(depth->getVerticalFieldOfView() / 2), camera.fy, 1e-4);
  EXPECT_EQ(depth->getMaxPixelValue(), 65535);
  EXPECT_EQ(depth->getMinPixelValue(), 0);
  EXPECT_EQ(depth->getSensorInfo().getSupportedVideoModes().getSize(), 4);
  EXPECT_EQ(device.getSensorInfo(openni::SENSOR_IR), nullptr);
  int x = 0, y = 0;
  EXPECT_EQ(openni::CoordinateConverter::convertDepthToColor(*depth.operator->(), *colour.operator->(), 7, 9,
                                                             openni::DepthPixel{1000}, &x, &y),
            STATUS_OK);
  EXPECT_EQ(cv::Point(x, y), cv::Point(7, 9));

  openni::CameraSettings* camera_settings = colour->getCameraSettings();
  ASSERT_NE(camera_settings, nullptr);
  EXPECT_TRUE(camera_settings->getAutoExposureEnabled());
  EXPECT_EQ(camera_settings->setAutoExposureEnabled(false), STATUS_OK);
  EXPECT_FALSE(camera_settings->getAutoExposureEnabled());
  EXPECT_EQ(camera_settings->setAutoWhiteBalanceEnabled(false), STATUS_OK);
  EXPECT_FALSE(camera_settings->getAutoWhiteBalanceEnabled());
  EXPECT_EQ(camera_settings->setExposure(20), STATUS_OK);
  EXPECT_EQ(camera_settings->getExposure(), 20);
  EXPECT_NE(camera_settings->setExposure(100000), STATUS_OK);
  EXPECT_EQ(camera_settings->getExposure(), 20);
}

TEST_F(VirtualDeviceTest, SettingsCanSucceedAndDoNothing) {
  offer_scene("&ignores_settings=1");
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH), colour(device, SENSOR_COLOR);
  EXPECT_EQ(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), STATUS_OK);
  EXPECT_EQ(device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  EXPECT_EQ(depth->setMirroringEnabled(true), STATUS_OK);
  EXPECT_FALSE(depth->getMirroringEnabled());
  EXPECT_EQ(colour->getCameraSettings()->setAutoExposureEnabled(false), STATUS_OK);
  EXPECT_TRUE(colour->getCameraSettings()->getAutoExposureEnabled());
}

TEST_F(VirtualDeviceTest, HalfTheSizeIsTheEvenPixels) {
  const std::vector<Frame> frames = expected();
  offer_scene("");
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH), colour(device, SENSOR_COLOR);
  openni::VideoMode mode = depth->getVideoMode();
  EXPECT_EQ(mode.getResolutionX(), 160);
  EXPECT_EQ(mode.getFps(), 30);
  mode.setResolution(80, 60);
  mode.setFps(60);
  ASSERT_EQ(depth->setVideoMode(mode), STATUS_OK);
  mode.setPixelFormat(openni::PIXEL_FORMAT_RGB888);
  ASSERT_EQ(colour->setVideoMode(mode), STATUS_OK);
  mode.setResolution(81, 60);
  EXPECT_NE(colour->setVideoMode(mode), STATUS_OK);
  ASSERT_EQ(depth->start(), STATUS_OK);
  ASSERT_EQ(colour->start(), STATUS_OK);
  SeenFrame seen;
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(depth.read(seen));
    EXPECT_TRUE(equal(seen.image, depth_of(frames[static_cast<std::size_t>(seen.index - 1) % 7], 2)));
    ASSERT_TRUE(colour.read(seen));
    EXPECT_TRUE(equal(seen.image, colour_of(frames[static_cast<std::size_t>(seen.index - 1) % 7], 2)));
  }
}

TEST_F(VirtualDeviceTest, MirrorsAndCrops) {
  const std::vector<Frame> frames = expected();
  offer_scene("");
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH), colour(device, SENSOR_COLOR);
  EXPECT_EQ(depth->setMirroringEnabled(true), STATUS_OK);
  EXPECT_EQ(colour->setMirroringEnabled(true), STATUS_OK);
  EXPECT_NE(depth->setCropping(100, 50, 61, 20), STATUS_OK);
  ASSERT_EQ(depth->setCropping(100, 50, 60, 20), STATUS_OK);
  ASSERT_EQ(colour->setCropping(1, 2, 33, 44), STATUS_OK);
  ASSERT_EQ(depth->start(), STATUS_OK);
  ASSERT_EQ(colour->start(), STATUS_OK);
  const auto mirrored = [](const cv::Mat& image) {
    cv::Mat turned(image.size(), image.type());
    for (int column = 0; column < image.cols; ++column)
      image.col(image.cols - 1 - column).copyTo(turned.col(column));
    return turned;
  };
  SeenFrame seen;
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(depth.read(seen));
    EXPECT_EQ(seen.crop, cv::Rect(100, 50, 60, 20));
    const Frame& frame = frames[static_cast<std::size_t>(seen.index - 1) % 7];
    EXPECT_TRUE(equal(seen.image, mirrored(depth_of(frame))(seen.crop)));
    ASSERT_TRUE(colour.read(seen));
    EXPECT_EQ(seen.crop, cv::Rect(1, 2, 33, 44));
    const Frame& other = frames[static_cast<std::size_t>(seen.index - 1) % 7];
    EXPECT_TRUE(equal(seen.image, mirrored(colour_of(other))(seen.crop)));
  }
}

TEST_F(VirtualDeviceTest, FractionsOfMillimetresAreRounded) {
  offer("synthetic:room?seed=1&size=64x48");
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH);
  ASSERT_EQ(depth->start(), STATUS_OK);
  SeenFrame seen;
  ASSERT_TRUE(depth.read(seen));
  const auto source = open_source("synthetic:room?seed=1&size=64x48");
  Frame frame;
  source->read(frame, milliseconds(0));
  EXPECT_TRUE(equal(seen.image, depth_of(frame)));
}

TEST_F(VirtualDeviceTest, LossByEventAndReturn) {
  offer_scene("&loss_after=5&back_after_ms=50");
  DeviceEvents events;
  for (int round = 1; round <= 3; ++round) {
    Device device;
    open(device);
    SeenStream depth(device, SENSOR_DEPTH);
    ASSERT_EQ(depth->start(), STATUS_OK);
    ASSERT_TRUE(frames_come(depth));
    ASSERT_TRUE(events.wait_for("disconnected", round));
    ASSERT_TRUE(events.wait_for("connected", round));
  }
}

TEST_F(VirtualDeviceTest, WithoutReturnItCannotBeOpenedAgain) {
  offer_scene("&loss_after=3");
  DeviceEvents events;
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH);
  ASSERT_EQ(depth->start(), STATUS_OK);
  ASSERT_TRUE(events.wait_for("disconnected"));
  EXPECT_THAT(uris(), IsEmpty());
  Device again;
  EXPECT_NE(again.open("saccade-virtual://0"), STATUS_OK);
}

TEST_F(VirtualDeviceTest, LossByErrorState) {
  offer_scene("&loss_after=3&loss=state&back_after_ms=20");
  DeviceEvents events;
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH);
  ASSERT_EQ(depth->start(), STATUS_OK);
  ASSERT_TRUE(events.wait_for("error"));
  ASSERT_TRUE(events.wait_for("ok"));
  EXPECT_TRUE(events.wait_for("error", 2));  // frames came again, and then the next loss
  EXPECT_EQ(events.count("disconnected"), 0);
}

TEST_F(VirtualDeviceTest, SilentLossTellsNothing) {
  offer_scene("&loss_after=3&loss=silent");
  DeviceEvents events;
  Device device;
  open(device);
  {
    SeenStream depth(device, SENSOR_DEPTH);
    ASSERT_EQ(depth->start(), STATUS_OK);
    int frames = 0;
    while (frames_come(depth, milliseconds(300))) ++frames;
    EXPECT_LE(frames, 3);
  }
  device.close();
  EXPECT_EQ(events.count("disconnected") + events.count("error"), 0);
  EXPECT_THAT(uris(), ::testing::Contains("saccade-virtual://0"));
  Device again;
  EXPECT_NE(again.open("saccade-virtual://0"), STATUS_OK) << "a device that is silent can be opened again";
}

TEST_F(VirtualDeviceTest, ArrivesLate) {
  const auto begin = std::chrono::steady_clock::now();
  offer_scene("&late_ms=800");
  while (uris().empty() && std::chrono::steady_clock::now() < begin + kGenerous)
    std::this_thread::sleep_for(milliseconds(5));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(800));
  Device device;
  open(device);
}

TEST_F(VirtualDeviceTest, ShortFramesSayThatTheyAreShort) {
  offer_scene("&short_frame=3");
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH);
  ASSERT_EQ(depth->start(), STATUS_OK);
  SeenFrame seen;
  int shorts = 0;
  while (shorts < 3) {
    ASSERT_TRUE(depth.read(seen));
    EXPECT_EQ(seen.data_size, seen.index % 3 == 0 ? 160 * 120 : 2 * 160 * 120);
    shorts += seen.image.empty() ? 1 : 0;
  }
}

TEST_F(VirtualDeviceTest, StallsShowInTheTimes) {
  offer_scene("&stall_ms=200&stall_after=4");
  Device device;
  open(device);
  SeenStream depth(device, SENSOR_DEPTH);
  ASSERT_EQ(depth->start(), STATUS_OK);
  std::map<int, std::uint64_t> times;
  SeenFrame seen;
  while (times.empty() || times.rbegin()->first < 10) {
    ASSERT_TRUE(depth.read(seen));
    times[seen.index] = seen.timestamp_us;
  }
  for (const auto& [index, time] : times)
    if (index % 4 == 0 && times.contains(index + 1)) {
      EXPECT_GE(times[index + 1] - time, 200'000U);
    }
}

TEST_F(VirtualDeviceTest, OpensAndClosesAtAnyMoment) {
  offer_scene("");
  for (int cycle = 0; cycle < 40; ++cycle) {
    Device device;
    open(device);
    std::optional<SeenStream> depth(std::in_place, device, SENSOR_DEPTH);
    SeenStream colour(device, SENSOR_COLOR);
    ASSERT_EQ(depth->operator->()->start(), STATUS_OK);
    ASSERT_EQ(colour->start(), STATUS_OK);
    if (cycle % 4 == 1) {
      ASSERT_TRUE(frames_come(*depth));
    }
    if (cycle % 4 == 2) {
      depth.reset();
      ASSERT_TRUE(frames_come(colour));
    }
    if (cycle % 4 == 3) {
      colour->stop();
      ASSERT_EQ(colour->start(), STATUS_OK);
      ASSERT_TRUE(frames_come(colour));
    }
  }
}

TEST_F(VirtualDeviceTest, OpenNiCanBeShutDownAndStartedAgainWhileTheDeviceComesAndGoes) {
  for (int cycle = 0; cycle < 3; ++cycle) {
    offer_scene("&loss_after=1&back_after_ms=1");
    DeviceEvents events;
    Device device;
    open(device);
    SeenStream depth(device, SENSOR_DEPTH);
    ASSERT_EQ(depth->start(), STATUS_OK);
    ASSERT_TRUE(events.wait_for("disconnected"));
    openni::OpenNI::shutdown();  // with the stream and the device open, and the device about to return
  }
}

TEST_F(VirtualDeviceTest, TwoClientsShareTheDevice) {
  offer_scene("");
  Device one, two;
  open(one);
  open(two);
  SeenStream first(one, SENSOR_DEPTH);
  ASSERT_EQ(first->start(), STATUS_OK);
  {
    SeenStream second(two, SENSOR_DEPTH);
    ASSERT_EQ(second->start(), STATUS_OK);
    ASSERT_TRUE(frames_come(second));
  }
  SeenFrame seen;
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(first.read(seen));
}

}  // namespace
}  // namespace saccade
