// Recordings of other programs, with their known contents. Skipped where the files are not available.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "oni/check.hpp"
#include "oni/recording.hpp"
#include "tests/support/outcome.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;

// The CRC-32 of zlib, bit by bit.
std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

struct Sample {
  std::string file;
  std::size_t depth_frames, other_frames;  // of the first depth stream, of all other streams
  std::vector<std::uint64_t> times_us;     // of the first depth frames
  std::vector<std::uint32_t> crcs;         // of the same, cropped as they are stored
};

const std::vector<Sample> kSamples = {
    {"formats/samples/ni1_16zP_jpeg_1frame.oni", 1, 1, {11680}, {0x63eaa418}},
    {"formats/samples/ni1_a.oni", 4, 4, {11680, 45049, 78419}, {0x63eaa418, 0x0166d3f7, 0xd08055ca}},
    {"formats/samples/sample.oni", 6, 7, {0, 38322, 69957}, {0x31d65a82, 0x9fce7d4d, 0xdb560760}},
    {"formats/samples/t_100_203_ir200.oni", 4, 11, {0, 33254, 66608}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_101_201.oni", 4, 4, {0, 30834, 64182}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_204.oni", 4, 5, {0, 33262, 66620}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_crop.oni",
     5,
     5,
     {0, 32290, 64507, 97839, 131181},
     {0x873dbbea, 0x0dd2d036, 0x53564c39, 0x5af8e85c, 0xfa2e0cd4}},
    {"formats/samples/t_dd.oni", 3, 3, {0, 33293, 66614}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_flat.oni", 3, 0, {0, 31956, 64154}, {0x4479e03c, 0x4479e03c, 0x4479e03c}},
    {"formats/samples/t_kill.oni", 9, 9, {0, 30832, 64147}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_lag.oni", 4, 4, {0, 33296, 68413}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_norm.oni", 5, 6, {0, 42378, 66600}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/t_prop.oni", 8, 0, {0, 33311, 70424}, {0x78f31779, 0x8b364cca, 0xd154ebc0}},
    {"formats/samples/tiny.oni", 2, 0, {0, 33274}, {0x3d8e5119, 0x1ddfa4e1}},
    {"data/oni/3dj_test.oni", 12, 12, {11680, 45049, 78419}, {0x63eaa418, 0x0166d3f7, 0xd08055ca}},
};

class OniSamples : public ::testing::Test {
 protected:
  static fs::path shared(const std::string& file) { return in_shared(file); }
  void SetUp() override {
    if (!fs::exists(shared("formats/samples/tiny.oni"))) GTEST_SKIP() << "no sample recordings";
  }
};

TEST_F(OniSamples, FramesTimesAndPixelsAreTheKnownOnes) {
  for (const Sample& sample : kSamples) {
    SCOPED_TRACE(sample.file);
    Recording recording(shared(sample.file));
    const OniNode& node = *main_depth(recording);
    ASSERT_EQ(node.frames.size(), sample.depth_frames);
    std::size_t all = 0;
    for (const OniNode& each : recording.index().nodes) all += each.frames.size();
    EXPECT_EQ(all - node.frames.size(), sample.other_frames);
    for (std::size_t k = 0; k < sample.crcs.size(); ++k) {
      EXPECT_EQ(node.frames[k].timestamp_us, sample.times_us[k]);
      cv::Mat1w depth;
      ASSERT_TRUE(succeeded(recording.read_stored_depth(node, k, depth)));
      const cv::Mat1w stored = depth(recording.format(node, k).crop).clone();
      EXPECT_EQ(crc32({stored.data, 2 * stored.total()}), sample.crcs[k]) << "frame " << k;
    }
  }
}

TEST_F(OniSamples, FramesReadInAnyOrderAreTheSame) {
  for (const Sample& sample : kSamples) {
    SCOPED_TRACE(sample.file);
    Recording recording(shared(sample.file));
    const OniNode& node = *main_depth(recording);
    std::vector<cv::Mat1f> sequence(node.frames.size());
    for (std::size_t k = 0; k < sequence.size(); ++k)
      ASSERT_TRUE(succeeded(recording.read_depth(node, k, sequence[k])));
    cv::Mat1f depth;
    for (std::size_t step = 1; step <= sequence.size(); ++step) {
      const std::size_t k = step * 7 % sequence.size();
      ASSERT_TRUE(succeeded(recording.read_depth(node, k, depth)));
      EXPECT_EQ(cv::norm(depth, sequence[k], cv::NORM_INF), 0) << k;
    }
  }
}

TEST_F(OniSamples, AllButTheInterruptedOneAreSound) {
  for (const Sample& sample : kSamples) {
    Recording recording(shared(sample.file));
    EXPECT_EQ(is_sound(check_recording(recording)), sample.file.find("t_kill") == std::string::npos)
        << sample.file;
  }
}

TEST_F(OniSamples, ColourImagesAreThoseOfTheStockPlayer) {
  Recording recording(shared("formats/samples/sample.oni"));
  const OniNode& colour_node = *main_colour(recording);
  for (std::size_t k = 0; k < 7; ++k) {
    const std::string name = "formats/samples/sample_frames/color_000" + std::to_string(k + 1) + ".png";
    const cv::Mat expected = cv::imread(shared(name).string(), cv::IMREAD_COLOR);
    cv::Mat3b colour;
    ASSERT_TRUE(succeeded(recording.read_colour(colour_node, k, colour)));
    ASSERT_EQ(expected.size(), colour.size());
    EXPECT_EQ(cv::norm(expected, colour, cv::NORM_INF), 0) << name;
  }
}

TEST_F(OniSamples, TheCameraComesFromTheFieldOfView) {
  const Recording recording(shared("data/oni/3dj_test.oni"));
  const OniNode& node = *main_depth(recording);
  const auto camera = intrinsics_at(node, recording.index().file_size, {640, 480});
  ASSERT_TRUE(camera.has_value());
  EXPECT_NEAR(camera->fx, 575.816, 1e-3);
  EXPECT_EQ(camera->origin, IntrinsicsOrigin::file);
}

}  // namespace
}  // namespace saccade
