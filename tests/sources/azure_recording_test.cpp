#include "sources/azure_recording.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "azure_calibration.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "matroska_writer.hpp"
#include "sources/open_source.hpp"
#include "tests/support/no_wait.hpp"
#include "tests/support/subprocess.hpp"
#include "video_files.hpp"

namespace saccade {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const cv::Size kDepthSize(320, 288);
const cv::Size kColourSize(1280, 720);
constexpr std::uint32_t kMjpg = 'M' | 'J' << 8 | 'P' << 16 | 'G' << 24;

cv::Mat1w azure_depth(int k) {
  cv::Mat1w depth(kDepthSize);
  for (int row = 0; row < depth.rows; ++row)
    for (int col = 0; col < depth.cols; ++col)
      depth(row, col) = static_cast<std::uint16_t>(600 + 40 * k + 3 * row + 2 * col);
  depth(cv::Rect(100, 100, 20, 30)) = 0;
  return depth;
}

std::vector<std::uint8_t> big_endian(const cv::Mat1w& image) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t value : image) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
  }
  return bytes;
}

// Each pixel says where it is.
cv::Mat3b place_image(int k, cv::Size size = kColourSize) {
  cv::Mat3b image(size);
  for (int row = 0; row < image.rows; ++row)
    for (int col = 0; col < image.cols; ++col)
      image(row, col) = cv::Vec3b(static_cast<std::uint8_t>(col / 6), static_cast<std::uint8_t>(row / 4),
                                  static_cast<std::uint8_t>(40 * k));
  return image;
}

std::vector<std::uint8_t> jpeg(const cv::Mat3b& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return bytes;
}

class AzureRecordingTest : public VideoFiles {
 protected:
  struct Options {
    bool colour = true, depth = true, infrared = true;
    int colour_start_ms = 0;
    std::string calibration = calibration_json();
  };

  std::string write(const Options& options) const {
    MatroskaTrack colour{"COLOR", kMjpg, kColourSize, 24, options.colour_start_ms, 33, {}};
    MatroskaTrack depth{"DEPTH", kB16g, kDepthSize, 16, 0, 33, {}};
    MatroskaTrack infrared{"IR", kB16g, kDepthSize, 16, 0, 33, {}};
    for (int k = 0; k < kFrames; ++k) {
      colour.packets.push_back(jpeg(place_image(k)));
      depth.packets.push_back(big_endian(azure_depth(k)));
      infrared.packets.push_back(big_endian(cv::Mat1w(kDepthSize, 77)));
    }
    std::vector<MatroskaTrack> tracks;
    if (options.colour) tracks.push_back(colour);
    if (options.depth) tracks.push_back(depth);
    if (options.infrared) tracks.push_back(infrared);
    tracks.push_back({"IMU", 0, {}, 0, 0, 10, std::vector<std::vector<std::uint8_t>>(18, {1, 2, 3, 4})});
    std::vector<MatroskaAttachment> attachments;
    if (!options.calibration.empty()) attachments.push_back({"calibration.json", options.calibration});
    write_matroska(path("azure.mkv"), tracks, attachments);
    return path("azure.mkv").string();
  }
};

TEST_F(AzureRecordingTest, DepthIsExactInAnyOrder) {
  const auto source = open_source(write({}));
  EXPECT_EQ(source->info().size, kDepthSize);
  EXPECT_TRUE(source->info().has_depth);
  EXPECT_EQ(source->info().depth_unit_mm, 1);
  Frame frame;
  for (const int k : {0, 1, 2, 3, 4, 5, 2, 4, 0}) {
    source->seek(k);
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame) << k;
    EXPECT_NEAR(static_cast<double>(frame.timestamp_us), 33000.0 * k, 1);
    cv::Mat1f expected;
    azure_depth(k).convertTo(expected, CV_32F);
    EXPECT_EQ(cv::norm(frame.depth_mm, expected, cv::NORM_INF), 0) << k;
    ASSERT_EQ(frame.colour.size(), kDepthSize);
    EXPECT_NEAR(cv::mean(frame.colour(cv::Rect(120, 120, 60, 60)))[2], 40 * k, 4) << k;
  }
  source->seek(kFrames);
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
}

// The sensor is 1024 x 1024 with its corner at (-1/2, -1/2); this mode halves it and cuts (96, 90) off.
TEST_F(AzureRecordingTest, CameraIsOfTheModeOfItsImages) {
  const Intrinsics camera = open_source(write({}))->info().intrinsics;
  EXPECT_EQ(camera.origin, IntrinsicsOrigin::file);
  EXPECT_NEAR(camera.fx, 0.492 * 512, 1e-6);
  EXPECT_NEAR(camera.fy, 0.4919 * 512, 1e-6);
  EXPECT_NEAR(camera.cx, 0.5014 * 512 - 96 - 0.5, 1e-6);
  EXPECT_NEAR(camera.cy, 0.4970 * 512 - 90 - 0.5, 1e-6);
  const AzureCalibration narrow(calibration_json(), {640, 576}, {2048, 1536});
  EXPECT_NEAR(narrow.depth.pinhole.cx, 0.5014 * 1024 - 192 - 0.5, 1e-6);
  EXPECT_NEAR(narrow.depth.pinhole.cy, 0.4970 * 1024 - 180 - 0.5, 1e-6);
  EXPECT_NEAR(narrow.colour.pinhole.cy, 0.5146 * 1536 - 0.5, 1e-6);
  const AzureCalibration wide(calibration_json(), {1024, 1024}, {1920, 1080});
  EXPECT_NEAR(wide.depth.pinhole.cx, 0.5014 * 1024 - 0.5, 1e-6);
  EXPECT_NEAR(wide.colour.pinhole.fx, 0.4789 * 1920, 1e-6);
  EXPECT_NEAR(wide.colour.pinhole.fy, 0.6385 * 1440, 1e-6);
  EXPECT_NEAR(wide.colour.pinhole.cy, 0.5146 * 1440 - 180 - 0.5, 1e-6);
  EXPECT_NEAR(cv::norm(wide.translation_mm - cv::Vec3d(-32.1, -2.2, 3.9)), 0, 1e-9);
}

// A calibration of the 16:9 middle of the sensor is the same camera in other numbers.
TEST_F(AzureRecordingTest, OldCalibrationsCoverTheMiddleOfTheSensor) {
  const AzureCalibration old(calibration_json("0.492", 2304), kDepthSize, kColourSize);
  EXPECT_NEAR(old.colour.pinhole.fy, 0.6385 * 720, 1e-6);
  EXPECT_NEAR(old.colour.pinhole.cy, 0.5146 * 720 - 0.5, 1e-6);
}

// The second opinion: OpenCV's projection, pixel by pixel.
TEST_F(AzureRecordingTest, ColourIsWhereTheOtherCameraSeesIt) {
  const AzureCalibration calibration(calibration_json(), kDepthSize, kColourSize);
  ColourRegistration registration(calibration.depth, calibration.colour, calibration.rotation,
                                  calibration.translation_mm);
  cv::Mat1f depth;
  azure_depth(0).convertTo(depth, CV_32F);
  cv::Mat3b registered;
  registration.apply(depth, place_image(0), registered);

  const auto matrix = [](const Intrinsics& camera) {
    return cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  };
  std::vector<cv::Point2f> pixels, rays, places;
  for (int row = 0; row < depth.rows; row += 7)
    for (int col = 0; col < depth.cols; col += 5)
      if (depth(row, col) > 0) pixels.emplace_back(static_cast<float>(col), static_cast<float>(row));
  cv::undistortPoints(pixels, rays, matrix(calibration.depth.pinhole), calibration.depth.distortion);
  std::vector<cv::Point3f> points;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const float z = depth(cv::Point(pixels[i]));
    points.emplace_back(rays[i].x * z, rays[i].y * z, z);
  }
  cv::Vec3d rotation;
  cv::Rodrigues(calibration.rotation, rotation);
  cv::projectPoints(points, rotation, calibration.translation_mm, matrix(calibration.colour.pinhole),
                    calibration.colour.distortion, places);
  int seen = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!cv::Rect(1, 1, kColourSize.width - 3, kColourSize.height - 3).contains(cv::Point(places[i])))
      continue;
    const cv::Vec3b colour = registered(cv::Point(pixels[i]));
    EXPECT_NEAR(colour[0], places[i].x / 6, 1.5) << pixels[i];
    EXPECT_NEAR(colour[1], places[i].y / 4, 1.5) << pixels[i];
    ++seen;
  }
  EXPECT_GT(seen, 1000);
}

TEST_F(AzureRecordingTest, ColourAtHolesIsThatOfTheSurfaceAround) {
  const AzureCalibration calibration(calibration_json(), kDepthSize, kColourSize);
  ColourRegistration registration(calibration.depth, calibration.colour, calibration.rotation,
                                  calibration.translation_mm);
  cv::Mat1f whole(kDepthSize, 1500), holes = whole.clone();
  holes(cv::Rect(140, 110, 40, 50)) = 0;
  cv::Mat3b expected, registered;
  registration.apply(whole, place_image(0), expected);
  registration.apply(holes, place_image(0), registered);
  EXPECT_EQ(cv::norm(expected, registered, cv::NORM_INF), 0);
  EXPECT_EQ(without_holes(cv::Mat1f(kDepthSize, 0)).size(), kDepthSize);  // no reading at all
}

TEST_F(AzureRecordingTest, StreamsThatBeginApartArePairedByTheTimesOfTheFile) {
  const auto source = open_source(write({.colour_start_ms = 66}));
  Frame frame;
  std::vector<int> colours;  // of each frame: the colour image, or none
  for (int k = 0; k < kFrames; ++k) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    colours.push_back(
        frame.colour.empty() ? -1 : cvRound(cv::mean(frame.colour(cv::Rect(120, 120, 60, 60)))[2] / 40));
  }
  EXPECT_THAT(colours, ::testing::ElementsAre(-1, -1, 0, 1, 2, 3));
}

// A second opinion, by a program that knows nothing of this one. It knows the codec as uncompressed pixels.
TEST_F(AzureRecordingTest, DepthIsThatOfFfmpeg) {
  if (run_program("ffmpeg", {"-version"}).status != 0) GTEST_SKIP() << "ffmpeg is not installed";
  const std::string file = write({}), raw = path("raw").string();
  const ProgramResult decoded = run_program("ffmpeg", {"-v", "error", "-i", file, "-map", "0:m:title:DEPTH",
                                                       "-f", "rawvideo", "-pix_fmt", "gray16le", raw});
  ASSERT_EQ(decoded.status, 0) << decoded.err;
  const auto bytes = read_file(raw);
  const auto pixels = static_cast<std::size_t>(kDepthSize.area());
  ASSERT_EQ(bytes.size(), 2 * pixels * kFrames);
  const auto source = open_source(file);
  Frame frame;
  for (std::size_t k = 0; k < kFrames; ++k) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    const cv::Mat stored(kDepthSize, CV_16UC1, const_cast<std::uint8_t*>(bytes.data() + 2 * pixels * k));
    cv::Mat1f expected;
    stored.convertTo(expected, CV_32F);
    EXPECT_EQ(cv::norm(frame.depth_mm, expected, cv::NORM_INF), 0) << k;
  }
}

// Once for its kind, and once for each of the two streams that are read.
TEST_F(AzureRecordingTest, TheFileIsOpenedOnceForEachStream) {
  const std::string file = write({});
  FileWatch watch(file);
  const auto source = open_source(file);
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(watch.closed(), 1);
  EXPECT_EQ(watch.open(), 4) << "packets and their checksums";
}

TEST_F(AzureRecordingTest, DepthNeedsNoColour) {
  const auto source = open_source(write({.colour = false}));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_TRUE(frame.colour.empty());
  EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::file);
}

TEST_F(AzureRecordingTest, CalibrationThatCannotBeUsedIsANote) {
  const std::string good = calibration_json();
  const auto with_width = [&](const std::string& width) {
    std::string bad = good;
    return bad.replace(bad.find(":1024}"), 5, ":" + width);
  };
  for (const std::string& bad :
       {with_width("8e26"), with_width("0"), with_width("1024.5"), with_width("9223372036854775807"),
        std::string(), std::string("not JSON"), good.substr(0, good.size() / 2), calibration_json("-1"),
        calibration_json("1e300"), calibration_json("\"wide\""), std::string(200'000, '['),
        std::string(R"({"CalibrationInformation":{"Cameras":[]}})"), std::string("{}")}) {
    SCOPED_TRACE(bad.substr(0, 80));
    const auto source = open_source(write({.calibration = bad}));
    EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::guess);
    EXPECT_THAT(source->info().notes, Contains(HasSubstr("no calibration")));
    EXPECT_THAT(source->info().notes, Contains(HasSubstr("cannot be registered")));
    Frame frame;
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_EQ(frame.colour.size(), kDepthSize);
  }
  // The firmware ends it with a zero.
  EXPECT_THAT(open_source(write({.calibration = good + '\0'}))->info().notes,
              Not(Contains(HasSubstr("no calibration"))));
}

TEST_F(AzureRecordingTest, InfraredAloneIsRefusedWithTheReason) {
  const std::string file = write({.depth = false});
  try {
    open_source(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::unreadable);
    EXPECT_THAT(error.what(), HasSubstr("infrared, but no depth"));
  }
}

TEST_F(AzureRecordingTest, WhatATruncatedRecordingHoldsIsRead) {
  const std::string file = write({});
  cut("azure.mkv", 0.6);
  const auto source = open_source(file);
  Frame frame;
  int frames = 0;
  for (ReadStatus status = ReadStatus::frame; status != ReadStatus::end && frames < 100;) {
    status = source->read(frame, kNoWait).status;
    frames += status == ReadStatus::frame ? 1 : 0;
  }
  EXPECT_GE(frames, 2);
  EXPECT_LT(frames, kFrames);
}

TEST(LensCameraTest, DistortionOfNoneIsNone) {
  const LensCamera plain{{640, 480}, {500, 500, 319.5, 239.5}, {}};
  EXPECT_EQ(plain.greatest_distortion_px(), 0);
  const cv::Point2d pixel = plain.pixel(0.1, -0.2);
  EXPECT_NEAR(pixel.x, 369.5, 1e-9);
  EXPECT_NEAR(pixel.y, 139.5, 1e-9);
  LensCamera barrel = plain;
  barrel.distortion[0] = -0.1;  // k1: a corner at r2 = .64 moves by .064 of its distance of 400 px
  EXPECT_NEAR(barrel.greatest_distortion_px(), 0.1 * 0.638 * 399.4, 0.3);
}

}  // namespace
}  // namespace saccade
