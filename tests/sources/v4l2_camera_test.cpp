// Cameras of the system. This program replaces ioctl(), with which a program speaks to a driver: a file plays
// the camera, and its pages are the memory that a driver shares.
#include <linux/videodev2.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <deque>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "oni/jpeg.hpp"
#include "sources/open_source.hpp"
#include "tests/support/folder_test.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kBufferBytes = 1 << 16;

// The driver of a camera, as far as a program sees it.
struct Driver {
  std::uint32_t format = V4L2_PIX_FMT_YUYV, width = 32, height = 16, row_bytes = 64;
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::deque<Bytes> pictures;  // to come; an empty one has the mark of an error
  bool unplugged = false;
  std::deque<std::uint32_t> queued;
  bool streams = false;

  int answer(int file, unsigned long request, void* argument) {
    if (unplugged) return ENODEV;
    switch (request) {
      case VIDIOC_QUERYCAP:
        static_cast<v4l2_capability*>(argument)->capabilities = capabilities;
        return 0;
      case VIDIOC_S_FMT: {
        v4l2_pix_format& pix = static_cast<v4l2_format*>(argument)->fmt.pix;
        pix.pixelformat = format;
        pix.width = width;
        pix.height = height;
        pix.bytesperline = row_bytes;
        return 0;
      }
      case VIDIOC_S_PARM:
        return EINVAL;  // it has one rate
      case VIDIOC_G_PARM:
        static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {1, 25};
        return 0;
      case VIDIOC_REQBUFS:
        static_cast<v4l2_requestbuffers*>(argument)->count = 2;
        return ::ftruncate(file, 2 * kBufferBytes);
      case VIDIOC_STREAMON:
        streams = true;
        return 0;
      case VIDIOC_STREAMOFF:
        streams = false;
        return 0;
      default:
        return answer_buffer(file, request, *static_cast<v4l2_buffer*>(argument));
    }
  }

  int answer_buffer(int file, unsigned long request, v4l2_buffer& buffer) {
    if (request == VIDIOC_QUERYBUF) {
      buffer.m.offset = buffer.index * kBufferBytes;
      buffer.length = kBufferBytes;
      return 0;
    }
    if (request == VIDIOC_QBUF) {
      queued.push_back(buffer.index);
      return 0;
    }
    if (request != VIDIOC_DQBUF) return EINVAL;
    if (pictures.empty() || queued.empty()) return EAGAIN;
    buffer.index = queued.front();
    queued.pop_front();
    const Bytes picture = pictures.front();
    pictures.pop_front();
    buffer.flags = picture.empty() ? V4L2_BUF_FLAG_ERROR : 0;
    buffer.bytesused = static_cast<std::uint32_t>(picture.size());
    const auto written = ::pwrite(file, picture.data(), picture.size(), buffer.index * kBufferBytes);
    return written == static_cast<ssize_t>(picture.size()) ? 0 : EIO;
  }
};

Driver* driver = nullptr;

}  // namespace

extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (driver == nullptr) return static_cast<int>(::syscall(SYS_ioctl, file, request, argument));
  errno = driver->answer(file, request, argument);
  return errno == 0 ? 0 : -1;
}

namespace saccade {
namespace {

using ::testing::HasSubstr;
constexpr std::chrono::milliseconds kNow{0};

class V4l2CameraTest : public FolderTest {
 protected:
  V4l2CameraTest() {
    std::ofstream(device_).put(0);
    driver = &driver_;
  }
  ~V4l2CameraTest() override { driver = nullptr; }

  std::unique_ptr<FrameSource> open() const { return open_source("v4l2:" + device_.string()); }
  std::string complaint() const {
    try {
      open();
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }

  // Two pictures, since the opening takes one.
  void put_twice(const Bytes& picture) { driver_.pictures.insert(driver_.pictures.end(), 2, picture); }

  cv::Mat3b first_picture(FrameSource& source) const {
    Frame frame;
    EXPECT_EQ(source.read(frame, kNow).status, ReadStatus::frame);
    return frame.colour;
  }

  const std::filesystem::path device_ = folder_ / "camera";
  Driver driver_;
};

TEST_F(V4l2CameraTest, GivesPicturesWithoutDepth) {
  put_twice(Bytes(64 * 16, 128));  // grey, without colour
  const auto source = open();
  EXPECT_TRUE(driver_.streams);
  EXPECT_TRUE(source->info().live);
  EXPECT_FALSE(source->info().has_depth);
  EXPECT_EQ(source->info().size, cv::Size(32, 16));
  EXPECT_EQ(source->info().rate_hz, 25);
  Frame frame;
  ASSERT_EQ(source->read(frame, kNow).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 0);
  EXPECT_EQ(frame.colour(5, 7), cv::Vec3b(130, 130, 130)) << "(128 - 16) * 255/219";
  EXPECT_EQ(cv::countNonZero(frame.depth_mm), 0);
  EXPECT_EQ(source->read(frame, kNow).status, ReadStatus::timeout);
}

TEST_F(V4l2CameraTest, TheMemoryIsUsedAgain) {
  for (int i = 0; i < 10; ++i) driver_.pictures.emplace_back(64 * 16, static_cast<std::uint8_t>(16 + 20 * i));
  const auto source = open();
  Frame frame;
  for (int i = 1; i < 10; ++i) {
    ASSERT_EQ(source->read(frame, kNow).status, ReadStatus::frame) << i;
    EXPECT_EQ(frame.index, i - 1);
  }
  EXPECT_EQ(driver_.queued.size(), 2U);
}

TEST_F(V4l2CameraTest, EveryFormatGivesItsColours) {
  const cv::Vec3b colour(200, 60, 20);  // blue
  const cv::Mat3b expected(16, 32, colour);
  const auto near = [&](std::uint32_t format, std::uint32_t row_bytes, const Bytes& picture,
                        const cv::Mat3b& image) {
    driver_ = {};
    driver_.format = format;
    driver_.row_bytes = row_bytes;
    put_twice(picture);
    const auto source = open();
    EXPECT_LE(cv::norm(first_picture(*source), image, cv::NORM_INF), 6) << "format " << format;
  };
  Bytes bgr, rgb, yuyv, uyvy, grey(40 * 16, 77), nv12(32 * 16);
  for (int i = 0; i < 32 * 16; ++i) {
    bgr.insert(bgr.end(), {200, 60, 20});
    rgb.insert(rgb.end(), {20, 60, 200});
  }
  const std::uint8_t y = 71, u = 195, v = 100;  // BT.601, 16..235
  for (int i = 0; i < 16 * 16; ++i) {
    yuyv.insert(yuyv.end(), {y, u, y, v});
    uyvy.insert(uyvy.end(), {u, y, v, y});
  }
  std::ranges::fill(nv12, y);
  for (int i = 0; i < 16 * 8; ++i) nv12.insert(nv12.end(), {u, v});
  near(V4L2_PIX_FMT_BGR24, 96, bgr, expected);
  near(V4L2_PIX_FMT_RGB24, 96, rgb, expected);
  near(V4L2_PIX_FMT_YUYV, 64, yuyv, expected);
  near(V4L2_PIX_FMT_UYVY, 64, uyvy, expected);
  near(V4L2_PIX_FMT_NV12, 32, nv12, expected);
  near(V4L2_PIX_FMT_GREY, 40, grey, cv::Mat3b(16, 32, cv::Vec3b(77, 77, 77)));
  Bytes jpeg;
  JpegCodec().encode(expected, 95, jpeg);
  near(V4L2_PIX_FMT_JPEG, 0, jpeg, expected);
  jpeg.insert(jpeg.end(), 20, 0);  // as cameras pad it
  near(V4L2_PIX_FMT_MJPEG, 0, jpeg, expected);
}

TEST_F(V4l2CameraTest, DamagedPicturesAreRejectedAndCounted) {
  put_twice(Bytes(64 * 16, 128));
  driver_.pictures.insert(driver_.pictures.begin() + 1, {Bytes(), Bytes(64 * 15, 128)});
  const auto source = open();
  Frame frame;
  EXPECT_EQ(source->read(frame, kNow).status, ReadStatus::rejected) << "the driver marks an error";
  EXPECT_EQ(source->read(frame, kNow).status, ReadStatus::rejected) << "a row is missing";
  EXPECT_EQ(source->read(frame, kNow).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 2);
}

TEST_F(V4l2CameraTest, NoJpegIsDamage) {
  driver_.format = V4L2_PIX_FMT_MJPEG;
  put_twice(Bytes(500, 7));
  const auto source = open();
  Frame frame;
  EXPECT_EQ(source->read(frame, kNow).status, ReadStatus::rejected);
}

TEST_F(V4l2CameraTest, AnUnpluggedCameraIsAnError) {
  put_twice(Bytes(64 * 16, 128));
  const auto source = open();
  driver_.unplugged = true;
  Frame frame;
  try {
    (void)source->read(frame, kNow);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the camera is lost: it gives no pictures: No such device"));
  }
}

TEST_F(V4l2CameraTest, RefusesWhatItCannotUse) {
  driver_.format = V4L2_PIX_FMT_Z16;
  EXPECT_THAT(complaint(), HasSubstr("none of the known formats"));
  driver_ = {};
  driver_.capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  EXPECT_THAT(complaint(), HasSubstr("does not stream pictures"));
  driver_ = {};
  driver_.width = 20'000;
  EXPECT_THAT(complaint(), HasSubstr("larger than"));
  driver = nullptr;
  EXPECT_THAT(complaint(), HasSubstr("no camera that gives pictures: not a camera"));
}

}  // namespace
}  // namespace saccade
