// Videos of colour without depth.
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "ffv1_writer.hpp"
#include "sources/open_source.hpp"
#include "tests/support/no_wait.hpp"
#include "video_files.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

// A texture that is lighter from image to image.
cv::Mat1b shaded_image(int k) {
  cv::Mat1b image(kSize);
  for (int r = 0; r < image.rows; ++r)
    for (int c = 0; c < image.cols; ++c)
      image(r, c) = static_cast<std::uint8_t>(30 + 30 * k + (7 * r + 13 * c + 31 * k) % 16);
  return image;
}

class ColourVideoTest : public VideoFiles {
 protected:
  // As shaded_image(); MPEG-4.
  void write_shades(const std::string& name, const Mpeg4Options& options = {}) const {
    std::vector<cv::Mat1b> images;
    for (int k = 0; k < kFrames; ++k) images.push_back(shaded_image(k));
    write_mpeg4(path(name), images, options);
  }
};

// The status of each position; the pictures between them are the right ones.
std::vector<ReadStatus> read_shades(FrameSource& source) {
  return read_positions(source, [](int k, const Frame& frame) {
    EXPECT_NEAR(static_cast<double>(frame.timestamp_us), k * 1e6 / 30, 1000);
    // From the luma of video to the whole range.
    EXPECT_NEAR(cv::mean(frame.colour)[0], (cv::mean(shaded_image(k))[0] - 16) * 255 / 219, 6) << k;
  });
}

TEST_F(ColourVideoTest, ColourIsReadFromEveryContainerAndInTheOrderOfTime) {
  for (const char* name : {"v.mkv", "v.avi", "v.mp4", "v.nut"})
    for (const int b_frames : {0, 2}) {
      const std::string_view ending = std::string_view(name).substr(2);
      if (b_frames > 0 && (ending == "avi" || ending == "nut")) continue;  // their times are of the decoding
      SCOPED_TRACE(fmt::format("{}, {}", name, b_frames));
      write_shades(name, {.key_every = kFrames, .b_frames = b_frames});
      const auto source = open_source(path(name).string());
      EXPECT_THAT(read_shades(*source), ElementsAreArray(std::vector(kFrames, ReadStatus::frame)));
      source->seek(0);
      EXPECT_EQ(read_shades(*source).size(), kFrames);
    }
}

TEST_F(ColourVideoTest, ImagesThatATruncatedColourVideoHasLostAreRejected) {
  for (const auto& [name, share] :
       {std::pair("v.mkv", 0.5), std::pair("v.mkv", 0.8), std::pair("v.avi", 0.8)}) {
    SCOPED_TRACE(fmt::format("{} at {}", name, share));
    write_shades(name);
    cut(name, share);
    const auto all = read_shades(*open_source(path(name).string()));
    EXPECT_EQ(all.size(), kFrames);
    EXPECT_GE(rejected_of(all), 1);
    EXPECT_LT(rejected_of(all), kFrames);
  }
}

TEST_F(ColourVideoTest, DamageOfAColourVideoIsRejectedWithAllThatDependsOnIt) {
  for (const int key_every : {1, 3}) {
    std::ptrdiff_t most = 0;
    for (const double share : {0.4, 0.5, 0.6, 0.7}) {
      SCOPED_TRACE(fmt::format("key frames every {}, at {}", key_every, share));
      write_shades("v.mkv", {.key_every = key_every, .container_crc = false});
      damage("v.mkv", share, 60);
      const auto all = read_shades(*open_source(path("v.mkv").string()));
      EXPECT_EQ(all.size(), kFrames);
      EXPECT_GE(rejected_of(all), 1);
      EXPECT_LT(rejected_of(all), kFrames);
      most = std::max(most, rejected_of(all));
    }
    EXPECT_GE(most, key_every == 1 ? 1 : 2);
  }
}

TEST_F(ColourVideoTest, AVideoOfATurnedCameraIsShownUpright) {
  write_shades("v.mov", {.turned_degrees = 90});
  const auto source = open_source(path("v.mov").string());
  EXPECT_EQ(source->info().size, cv::Size(kSize.height, kSize.width));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  cv::Mat1b upright;
  cv::rotate(shaded_image(0), upright, cv::ROTATE_90_CLOCKWISE);
  cv::Mat1b grey;
  cv::extractChannel(frame.colour, grey, 0);
  cv::Mat1f read, expected;
  grey.convertTo(read, CV_32F);
  upright.convertTo(expected, CV_32F, 255.0 / 219, -16 * 255.0 / 219);
  EXPECT_LT(cv::norm(read, expected, cv::NORM_L1) / static_cast<double>(read.total()), 3);
}

}  // namespace
}  // namespace saccade
