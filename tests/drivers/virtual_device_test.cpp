// The virtual device as a program sees it: when it is listed, its frames, its settings.
#include <algorithm>
#include <cstdint>
#include <map>

#include "tests/support/places.hpp"
#include "virtual_device_fixture.hpp"

namespace saccade {
namespace {

using openni::STATUS_OK;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(VirtualDeviceTest, IsListedOnlyWhenAskedFor) {
  start();
  EXPECT_THAT(uris(), Not(Contains(HasSubstr("saccade"))));
  openni::OpenNI::shutdown();
  offer(kScene);
  EXPECT_THAT(uris(), Contains(kUri));
}

TEST_F(VirtualDeviceTest, AnUnplayableSourceGivesOneLineAndNoDevice) {
  for (const std::string& text :
       std::vector<std::string>{"/no/such/folder", "synthetic:table?sead=3", "synthetic:table?loss=lost",
                                "openni2", in_source("README.md")}) {
    ::testing::internal::CaptureStderr();
    offer(text);
    const std::string err = ::testing::internal::GetCapturedStderr();
    EXPECT_THAT(uris(), IsEmpty());
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_THAT(err, HasSubstr("SACCADE_VIRTUAL_DEVICE"));
    openni::OpenNI::shutdown();
  }
}

TEST_F(VirtualDeviceTest, ARelativePathIsSeenFromTheFolderOfTheShell) {
  const char* pwd = std::getenv("PWD");
  const std::optional<std::string> before = pwd != nullptr ? std::optional<std::string>(pwd) : std::nullopt;
  ::setenv("PWD", in_source("").c_str(), 1);
  offer("recordings/table.oni");
  EXPECT_THAT(uris(), Contains(kUri));
  if (before)
    ::setenv("PWD", before->c_str(), 1);
  else
    ::unsetenv("PWD");
}

TEST_F(VirtualDeviceTest, GivesTheFramesOfTheSourceWithDepthAndColourOfOneMoment) {
  stream_both();
  std::map<int, std::uint64_t> times;
  std::size_t pairs = 0;
  const auto note_time = [&](const SeenFrame& seen) {
    const auto [place, is_new] = times.emplace(seen.index, seen.timestamp_us);
    EXPECT_EQ(place->second, seen.timestamp_us);
    if (!is_new) ++pairs;
  };
  SeenFrame seen;
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(depth_->read(seen));
    EXPECT_TRUE(same_bytes(seen.image, depth_of(original(seen)))) << seen.index;
    note_time(seen);
    ASSERT_TRUE(colour_->read(seen));
    EXPECT_TRUE(same_bytes(seen.image, colour_of(original(seen)))) << seen.index;
    note_time(seen);
  }
  EXPECT_GT(pairs, 0U);
  for (auto now = std::next(times.begin()); now != times.end(); ++now)
    EXPECT_GT(now->second, std::prev(now)->second);
}

TEST_F(VirtualDeviceTest, FractionsOfMillimetresAreRounded) {
  constexpr const char* kRoom = "synthetic:room?seed=1&size=64x48";
  offer(kRoom);
  open();
  ASSERT_EQ((*depth_)->start(), STATUS_OK);
  SeenFrame seen;
  ASSERT_TRUE(depth_->read(seen));
  Frame frame;
  ASSERT_EQ(open_source(kRoom)->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_TRUE(same_bytes(seen.image, depth_of(frame)));
}

TEST_F(VirtualDeviceTest, DescribesItself) {
  open_scene();
  EXPECT_STREQ(device_.getDeviceInfo().getName(), "Virtual device");
  EXPECT_STREQ(device_.getDeviceInfo().getVendor(), "Saccade");
  char serial[64] = {};
  int size = sizeof serial;
  EXPECT_EQ(device_.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size), STATUS_OK);
  EXPECT_STREQ(serial, "VIRTUAL-1");
  size = 3;  // too small
  EXPECT_NE(device_.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size), STATUS_OK);
  EXPECT_EQ(device_.getSensorInfo(openni::SENSOR_IR), nullptr);
}

TEST_F(VirtualDeviceTest, ItsStreamsHaveThePropertiesThatProgramsAskFor) {
  open_scene();
  const openni::VideoStream& depth = *depth_->operator->();
  const openni::VideoStream& colour = *colour_->operator->();
  const Intrinsics camera = open_source(kScene)->info().intrinsics;
  EXPECT_NEAR(80 / std::tan(depth.getHorizontalFieldOfView() / 2), camera.fx, 1e-4);
  EXPECT_NEAR(60 / std::tan(depth.getVerticalFieldOfView() / 2), camera.fy, 1e-4);
  EXPECT_EQ((*depth_)->getMaxPixelValue(), 65535);
  EXPECT_EQ((*depth_)->getMinPixelValue(), 0);
  EXPECT_EQ(depth.getSensorInfo().getSupportedVideoModes().getSize(), 4);
  int stride = 0, size = sizeof stride;
  EXPECT_EQ(colour.getProperty(openni::STREAM_PROPERTY_STRIDE, &stride, &size), STATUS_OK);
  EXPECT_EQ(stride, 3 * 160);
  int x = 0, y = 0;
  EXPECT_EQ(
      openni::CoordinateConverter::convertDepthToColor(depth, colour, 7, 9, openni::DepthPixel{1000}, &x, &y),
      STATUS_OK);
  EXPECT_EQ(cv::Point(x, y), cv::Point(7, 9));
}

TEST_F(VirtualDeviceTest, SettingsAreKeptAndReadBack) {
  open_scene();
  EXPECT_EQ(device_.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  EXPECT_TRUE(device_.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
  EXPECT_EQ(device_.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), STATUS_OK);
  EXPECT_EQ(device_.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  EXPECT_EQ(device_.setDepthColorSyncEnabled(true), STATUS_OK);
  openni::CameraSettings* camera = (*colour_)->getCameraSettings();
  ASSERT_NE(camera, nullptr);
  EXPECT_TRUE(camera->getAutoExposureEnabled());
  EXPECT_EQ(camera->setAutoExposureEnabled(false), STATUS_OK);
  EXPECT_FALSE(camera->getAutoExposureEnabled());
  EXPECT_EQ(camera->setAutoWhiteBalanceEnabled(false), STATUS_OK);
  EXPECT_FALSE(camera->getAutoWhiteBalanceEnabled());
  EXPECT_EQ(camera->setExposure(20), STATUS_OK);
  EXPECT_EQ(camera->getExposure(), 20);
  EXPECT_NE(camera->setExposure(100000), STATUS_OK);
  EXPECT_EQ(camera->getExposure(), 20);
}

TEST_F(VirtualDeviceTest, HalfTheSizeIsTheEvenPixels) {
  open_scene();
  openni::VideoMode mode = (*depth_)->getVideoMode();
  EXPECT_EQ(mode.getResolutionX(), 160);
  EXPECT_EQ(mode.getFps(), 30);
  mode.setResolution(80, 60);
  mode.setFps(60);
  ASSERT_EQ((*depth_)->setVideoMode(mode), STATUS_OK);
  mode.setPixelFormat(openni::PIXEL_FORMAT_RGB888);
  ASSERT_EQ((*colour_)->setVideoMode(mode), STATUS_OK);
  mode.setResolution(81, 60);
  EXPECT_NE((*colour_)->setVideoMode(mode), STATUS_OK);
  ASSERT_EQ((*depth_)->start(), STATUS_OK);
  ASSERT_EQ((*colour_)->start(), STATUS_OK);
  SeenFrame seen;
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(depth_->read(seen));
    EXPECT_TRUE(same_bytes(seen.image, depth_of(original(seen), 2)));
    ASSERT_TRUE(colour_->read(seen));
    EXPECT_TRUE(same_bytes(seen.image, colour_of(original(seen), 2)));
  }
}

cv::Mat mirrored(const cv::Mat& image) {
  cv::Mat turned(image.size(), image.type());
  for (int column = 0; column < image.cols; ++column)
    image.col(image.cols - 1 - column).copyTo(turned.col(column));
  return turned;
}

TEST_F(VirtualDeviceTest, MirrorsAndCrops) {
  open_scene();
  EXPECT_EQ((*depth_)->setMirroringEnabled(true), STATUS_OK);
  EXPECT_EQ((*colour_)->setMirroringEnabled(true), STATUS_OK);
  EXPECT_NE((*depth_)->setCropping(100, 50, 61, 20), STATUS_OK);
  ASSERT_EQ((*depth_)->setCropping(100, 50, 60, 20), STATUS_OK);
  ASSERT_EQ((*colour_)->setCropping(1, 2, 33, 44), STATUS_OK);
  ASSERT_EQ((*depth_)->start(), STATUS_OK);
  ASSERT_EQ((*colour_)->start(), STATUS_OK);
  SeenFrame seen;
  for (int k = 0; k < 4; ++k) {
    ASSERT_TRUE(depth_->read(seen));
    EXPECT_EQ(seen.crop, cv::Rect(100, 50, 60, 20));
    EXPECT_TRUE(same_bytes(seen.image, mirrored(depth_of(original(seen)))(seen.crop)));
    ASSERT_TRUE(colour_->read(seen));
    EXPECT_EQ(seen.crop, cv::Rect(1, 2, 33, 44));
    EXPECT_TRUE(same_bytes(seen.image, mirrored(colour_of(original(seen)))(seen.crop)));
  }
}

TEST_F(VirtualDeviceTest, OpensAndClosesAtAnyMoment) {
  offer_scene();
  SeenFrame seen;
  for (int cycle = 0; cycle < 40; ++cycle) {
    open();
    ASSERT_EQ((*depth_)->start(), STATUS_OK);
    ASSERT_EQ((*colour_)->start(), STATUS_OK);
    if (cycle % 4 == 1) {
      ASSERT_TRUE(depth_->read(seen));
    }
    if (cycle % 4 == 2) {
      depth_.reset();
      ASSERT_TRUE(colour_->read(seen));
    }
    if (cycle % 4 == 3) {
      (*colour_)->stop();
      ASSERT_EQ((*colour_)->start(), STATUS_OK);
      ASSERT_TRUE(colour_->read(seen));
    }
    close();
  }
}

TEST_F(VirtualDeviceTest, TwoClientsShareTheDevice) {
  stream_depth();
  SeenFrame seen;
  {
    openni::Device other;
    ASSERT_EQ(other.open(kUri), STATUS_OK);
    SeenStream second(other, openni::SENSOR_DEPTH);
    ASSERT_EQ(second->start(), STATUS_OK);
    ASSERT_TRUE(second.read(seen));
  }
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(depth_->read(seen));
}

}  // namespace
}  // namespace saccade
