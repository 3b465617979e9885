#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/fit_colour.hpp"
#include "core/png.hpp"
#include "ffv1_writer.hpp"
#include "matroska_writer.hpp"
#include "sources/open_source.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/no_wait.hpp"
#include "video_files.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Every one of the sixteen bits matters in these.
cv::Mat1w depth_image(int k, cv::Size size = kSize) {
  cv::Mat1w depth(size);
  for (int row = 0; row < depth.rows; ++row)
    for (int column = 0; column < depth.cols; ++column)
      depth(row, column) = static_cast<std::uint16_t>(37 * k + 1013 * row + 259 * column);
  return depth;
}

// One colour per image, which survives any codec well enough to identify the image.
cv::Mat3b colour_image(int k, cv::Size size = kSize) {
  return {size, cv::Vec3b(static_cast<std::uint8_t>(30 * k), 100, static_cast<std::uint8_t>(250 - 30 * k))};
}

class VideoSourceTest : public VideoFiles {
 protected:
  void write_ffv1(const std::string& name, const Ffv1Options& options = {}) const {
    std::vector<cv::Mat1w> images;
    for (int k = 0; k < kFrames; ++k) images.push_back(depth_image(k));
    saccade::write_ffv1(path(name), images, options);
  }

  void write_colour(const std::string& name, double rate_hz = 30, cv::Size size = kSize,
                    int frames = kFrames) const {
    cv::VideoWriter writer(path(name).string(), cv::CAP_OPENCV_MJPEG,
                           cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz, size);
    ASSERT_TRUE(writer.isOpened());
    for (int k = 0; k < frames; ++k) writer.write(colour_image(k, size));
  }

  void write_png_packets(const std::string& name) const {
    std::vector<std::vector<std::uint8_t>> packets;
    for (int k = 0; k < kFrames; ++k) packets.push_back(encode_png(depth_image(k)));
    write_matroska(path(name), fourcc("MPNG"), kSize, 16, 50, packets);
  }

  static std::uint32_t fourcc(const char* letters) {
    return static_cast<std::uint32_t>(
        cv::VideoWriter::fourcc(letters[0], letters[1], letters[2], letters[3]));
  }

  static std::string complaint(const std::string& source) {
    return error_of(ExitStatus::unreadable, [&] { open_source(source); });
  }
};

void expect_depth(FrameSource& source, int k) {
  Frame frame;
  ASSERT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame) << k;
  EXPECT_EQ(frame.index, k);
  const cv::Mat1w expected = depth_image(k);
  ASSERT_EQ(frame.depth_mm.size(), expected.size());
  for (int row = 0; row < expected.rows; ++row)
    for (int column = 0; column < expected.cols; ++column)
      ASSERT_EQ(frame.depth_mm(row, column), static_cast<float>(expected(row, column)));
}

// All frames in order, then any order.
void expect_exact(FrameSource& source) {
  Frame frame;
  for (int k = 0; k < kFrames; ++k) expect_depth(source, k);
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::end);
  for (const int k : {4, 1, 2, 5, 0}) {
    source.seek(k);
    expect_depth(source, k);
  }
  source.seek(kFrames + 3);
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::end);
}

TEST_F(VideoSourceTest, Ffv1InMatroskaIsExact) {
  write_ffv1("a b_depth.mkv");
  const auto source = open_source(path("a b_depth.mkv").string());
  EXPECT_EQ(source->info().size, kSize);
  EXPECT_NEAR(source->info().rate_hz, 30, 1e-6);
  EXPECT_TRUE(source->info().has_depth);
  EXPECT_FALSE(source->info().frame_count);
  expect_exact(*source);
  Frame frame;
  for (const int k : {3, 4, 1}) {
    source->seek(k);
    EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_NEAR(static_cast<double>(frame.timestamp_us), k * 1e6 / 30, 1000);
  }
}

TEST_F(VideoSourceTest, Ffv1IsExactInEveryContainerAndVersion) {
  for (const int level : {1, 3})
    for (const char* name : {"v_depth.mkv", "v_depth.avi", "v_depth.mov", "v_depth.nut"}) {
      SCOPED_TRACE(std::string(name) + " version " + std::to_string(level));
      write_ffv1(name, {.level = level, .key_every = 3});
      expect_exact(*open_source(path(name).string()));
    }
}

// libavformat cannot read what it writes into AVI and MOV.
TEST_F(VideoSourceTest, RawPixelsAreExactInEveryContainerAndByteOrder) {
  std::vector<cv::Mat1w> images;
  for (int k = 0; k < kFrames; ++k) images.push_back(depth_image(k));
  for (const bool big_endian : {false, true})
    for (const char* name : {"r_depth.mkv", "r_depth.avi", "r_depth.mov", "r_depth.nut"}) {
      SCOPED_TRACE(std::string(name) + (big_endian ? " big-endian" : ""));
      write_raw_grey(path(name), images, big_endian);
      expect_exact(*open_source(path(name).string()));
    }
}

TEST_F(VideoSourceTest, ACodecThatIsNotKnownIsSaid) {
  write_ffv1("f_depth.mov");
  auto bytes = read_file(path("f_depth.mov"));
  const std::string_view name = "FFV1";
  const auto at = std::find_end(bytes.begin(), bytes.end(), name.begin(), name.end());
  ASSERT_NE(at, bytes.end());
  *at = '?';
  write_file(path("f_depth.mov"), bytes);
  EXPECT_THAT(complaint(path("f_depth.mov").string()), HasSubstr("no codec is known for this video"));
}

// What reading to the end gives: the status of each frame, and that sound ones are exact.
std::vector<ReadStatus> read_all(FrameSource& source) {
  return read_positions(source, [](int k, const Frame& frame) {
    cv::Mat1f expected;
    depth_image(k).convertTo(expected, CV_32F);
    EXPECT_EQ(cv::countNonZero(expected != frame.depth_mm), 0) << k;
  });
}

TEST_F(VideoSourceTest, ImagesThatATruncatedFileHasLostAreRejected) {
  for (const double share : {0.35, 0.5, 0.8}) {
    write_ffv1("f_depth.mkv");
    cut("f_depth.mkv", share);
    const auto all = read_all(*open_source(path("f_depth.mkv").string()));
    EXPECT_EQ(all.size(), kFrames) << share;
    EXPECT_GE(rejected_of(all), 1) << share;
    EXPECT_LT(rejected_of(all), kFrames) << share;
  }
  write_png_packets("p.mkv");  // whose header names no duration
  cut("p.mkv", 0.5);
  EXPECT_GE(rejected_of(read_all(*open_source(path("p.mkv").string()))), 1);
}

// A header that announces years: a small file cannot have lost so many, and each would take memory.
TEST_F(VideoSourceTest, ASmallFileHasNotLostAMillionImages) {
  write_ffv1("f_depth.mkv");
  auto content = read_file(path("f_depth.mkv"));
  const std::array<std::uint8_t, 3> duration = {0x44, 0x89, 0x88};  // of 8 bytes
  const auto at = std::search(content.begin(), content.end(), duration.begin(), duration.end());
  ASSERT_NE(at, content.end());
  const std::array<std::uint8_t, 8> years = {0x42, 0x6D, 0x1A, 0x94, 0xA2, 0, 0, 0};  // 1e12 ms
  std::copy(years.begin(), years.end(), at + duration.size());
  write_file(path("f_depth.mkv"), content);
  cut("f_depth.mkv", 0.7);
  const auto source = open_source(path("f_depth.mkv").string());
  Frame frame;
  int rejected = 0;
  for (ReadStatus status; (status = source->read(frame, kNoWait).status) != ReadStatus::end;)
    rejected += status == ReadStatus::rejected;
  EXPECT_GE(rejected, 100);
  EXPECT_LE(rejected, 2000);
}

TEST_F(VideoSourceTest, DamagedFfv1IsRejectedAndNeverGivesOtherPixels) {
  // The checksums of the codec name the image; those of the container a few.
  for (const Ffv1Options& options :
       {Ffv1Options{}, Ffv1Options{.container_crc = false}, Ffv1Options{.slice_crc = false},
        Ffv1Options{.level = 1}, Ffv1Options{.key_every = 3}})
    for (const double share : {0.4, 0.5, 0.6, 0.7}) {
      write_ffv1("f_depth.mkv", options);
      damage("f_depth.mkv", share, 60);
      SCOPED_TRACE(fmt::format("version {}, {} {} {}, at {}", options.level, options.slice_crc,
                               options.container_crc, options.key_every, share));
      const auto source = open_source(path("f_depth.mkv").string());
      EXPECT_THAT(source->info().notes, Not(Contains(HasSubstr("no checksums"))));
      const auto all = read_all(*source);
      EXPECT_GE(rejected_of(all), 1);
      if (options.slice_crc && options.level == 3 && options.key_every == 1) {
        EXPECT_LE(rejected_of(all), 3);
      }
    }
}

TEST_F(VideoSourceTest, AFileWithoutChecksumsIsNoted) {
  write_ffv1("f_depth.mkv", {.level = 1, .container_crc = false});
  const auto source = open_source(path("f_depth.mkv").string());
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("no checksums")));
}

TEST_F(VideoSourceTest, AVideoCannotLeadToOtherFiles) {
  write_colour("secret.avi");
  for (const char* name : {"a.mp4", "a.mkv", "a.avi"})
    for (const std::string& text : {"#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:10,\n" +
                                        path("secret.avi").string() + "\n#EXT-X-ENDLIST\n",
                                    std::string("ffconcat version 1.0\nfile secret.avi\n")}) {
      write_file(path(name), text);
      EXPECT_THAT(complaint(path(name).string()), HasSubstr("no video")) << name;
    }
}

TEST_F(VideoSourceTest, PngInMatroskaIsExact) {
  write_png_packets("p.mkv");
  const auto source = open_source(path("p.mkv").string());
  EXPECT_NEAR(source->info().rate_hz, 20, 1e-6);
  expect_exact(*source);
}

TEST_F(VideoSourceTest, UncompressedGray16IsExact) {
  std::vector<std::vector<std::uint8_t>> packets;
  for (int k = 0; k < kFrames; ++k) {
    const cv::Mat1w depth = depth_image(k);
    packets.emplace_back(depth.data, depth.data + 2 * depth.total());
  }
  write_raw_matroska(path("r.mkv"), kSize, 50, packets);
  expect_exact(*open_source(path("r.mkv").string()));
}

// Times can be any numbers. Nothing overflows, and none is farther away than any sensor has existed.
TEST_F(VideoSourceTest, ImpossibleTimesAreLimited) {
  std::vector<std::vector<std::uint8_t>> packets;
  for (int k = 0; k < 4; ++k) {
    const cv::Mat1w depth = depth_image(k);
    packets.emplace_back(depth.data, depth.data + 2 * depth.total());
  }
  write_raw_matroska(path("good.mkv"), kSize, 50, packets);
  const auto good = read_file(path("good.mkv"));
  const auto big_endian = [](std::uint64_t value) {
    std::array<std::uint8_t, 8> bytes{};
    for (int i = 0; i < 8; ++i)
      bytes[static_cast<std::size_t>(7 - i)] = static_cast<std::uint8_t>(value >> (8 * i));
    return bytes;
  };
  // The nanoseconds of the file's unit, and the times of the second and of the third cluster in it.
  for (const std::uint64_t field : {1'000'000, 50, 100})
    for (const std::uint64_t value : {~std::uint64_t{0} >> 1, ~std::uint64_t{0}, std::uint64_t{1} << 63,
                                      (std::uint64_t{1} << 62) + 12345, std::uint64_t{1} << 40}) {
      SCOPED_TRACE(std::to_string(field) + " becomes " + std::to_string(value));
      auto bad = good;
      const auto before = big_endian(field), after = big_endian(value);
      const auto at = std::search(bad.begin(), bad.end(), before.begin(), before.end());
      ASSERT_NE(at, bad.end());
      std::copy(after.begin(), after.end(), at);
      write_file(path("bad.mkv"), bad);
      std::unique_ptr<FrameSource> source;
      try {
        source = open_source(path("bad.mkv").string());
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::unreadable);
        continue;
      }
      EXPECT_GE(source->info().rate_hz, 1e-3);
      EXPECT_LE(source->info().rate_hz, 1e6);
      Frame frame;
      for (int k = 0; k < 10; ++k) {
        const ReadStatus status = source->read(frame, kNoWait).status;
        if (status == ReadStatus::end) break;
        if (status == ReadStatus::frame) {
          EXPECT_LE(std::abs(frame.timestamp_us), 1'000'000'000'000'000);
        }
      }
    }
}

TEST_F(VideoSourceTest, PixelsThatAreTooManyOrTooFewAreRejected) {
  const cv::Mat1w depth = depth_image(0);
  std::vector<std::vector<std::uint8_t>> packets(3, {depth.data, depth.data + 2 * depth.total()});
  packets[1].resize(packets[1].size() - 1);
  packets[2].resize(packets[2].size() + 100'000);
  write_raw_matroska(path("r.mkv"), kSize, 50, packets);
  const auto source = open_source(path("r.mkv").string());
  expect_depth(*source, 0);
  for (const char* reason : {"6143 bytes for 64x48 pixels", "106144 bytes for 64x48 pixels"}) {
    Frame frame;
    const ReadResult read = source->read(frame, kNoWait);
    EXPECT_EQ(read.status, ReadStatus::rejected);
    EXPECT_THAT(read.reason, HasSubstr(reason));
  }
}

TEST_F(VideoSourceTest, ADamagedImageIsRejectedAndTheNextIsGood) {
  std::vector<std::vector<std::uint8_t>> packets;
  for (int k = 0; k < kFrames; ++k) packets.push_back(encode_png(depth_image(k)));
  packets[2][packets[2].size() / 2] ^= 0xff;
  packets[4] = encode_png(depth_image(4, {32, 48}));
  write_matroska(path("p.mkv"), fourcc("MPNG"), kSize, 16, 50, packets);
  const auto source = open_source(path("p.mkv").string());
  for (int k = 0; k < kFrames; ++k) {
    if (k != 2 && k != 4) {
      expect_depth(*source, k);
      continue;
    }
    Frame frame;
    const ReadResult read = source->read(frame, kNoWait);
    EXPECT_EQ(read.status, ReadStatus::rejected);
    EXPECT_THAT(read.reason, HasSubstr(k == 2 ? "not a valid PNG" : "32x48 instead of 64x48"));
  }
}

TEST_F(VideoSourceTest, NumberedImagesAreExactWithColourBeside) {
  for (int k = 0; k < kFrames; ++k) {
    write_file(path(fmt::format("depth_{:04}.png", k)), encode_png(depth_image(k)));
    write_file(path(fmt::format("rgb_{:04}.png", k)), encode_png(colour_image(k)));
  }
  write_file(path("meta.json"), std::string_view(R"({"fx":50,"fy":51,"cx":31,"cy":23})"));
  const auto source = open_source(path("depth_%04d.png").string());
  EXPECT_EQ(source->info().intrinsics.fx, 50);
  expect_exact(*source);
  for (const int k : {0, 1, 4, 2}) {
    source->seek(k);
    Frame frame;
    EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    ASSERT_EQ(frame.colour.size(), kSize);
    EXPECT_EQ(frame.colour(3, 3), colour_image(k)(3, 3)) << k;
  }
}

TEST_F(VideoSourceTest, DamagedAndMissingImagesOfAPatternAreRejectedOrNoted) {
  for (const int k : {3, 4, 6, 7, 8}) {
    write_file(path(fmt::format("depth_{:04}.png", k)), encode_png(depth_image(k)));
    write_file(path(fmt::format("rgb_{:04}.png", k)), encode_png(colour_image(k, {32, 24})));
  }
  auto damaged = encode_png(depth_image(4));
  damaged.resize(damaged.size() / 2);
  write_file(path("depth_0004.png"), damaged);
  write_file(path("rgb_0007.png"), std::string_view("no image"));
  write_file(path("depth_10000.png"), encode_png(depth_image(0)));
  write_file(path("depth_00009.png"), encode_png(depth_image(0)));  // not as printf writes it
  const auto source = open_source(path("depth_%04d.png").string());
  EXPECT_EQ(source->info().frame_count, 6);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("scaled")));
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("missing in the numbering: 5, 9..9999")));
  std::vector<ReadStatus> statuses;
  Frame frame;
  for (ReadResult read; (read = source->read(frame, kNoWait)).status != ReadStatus::end;) {
    statuses.push_back(read.status);
    if (frame.index == 0) {
      EXPECT_EQ(frame.colour.size(), kSize);
    }
    if (frame.index == 1) {
      EXPECT_THAT(read.reason, HasSubstr("depth_0004.png"));
    }
    if (frame.index == 3) {
      EXPECT_THAT(read.reason, HasSubstr("no colour: rgb_0007.png"));
    }
  }
  constexpr auto kGood = ReadStatus::frame, kBad = ReadStatus::rejected;
  EXPECT_THAT(statuses, ElementsAre(kGood, kBad, kGood, kGood, kGood, kGood));
}

TEST_F(VideoSourceTest, ColourBesideAVideoIsTheNearestInTimeAndScaled) {
  write_png_packets("a_depth.mkv");                   // every 50 ms
  write_colour("a_rgb.avi", 40, {128, 96}, kFrames);  // every 25 ms
  const auto source = open_source(path("a_depth.mkv").string());
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("scaled")));
  for (const int k : {0, 1, 2, 1}) {
    source->seek(k);
    Frame frame;
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    ASSERT_EQ(frame.colour.size(), kSize) << k;
    EXPECT_NEAR(frame.colour(9, 9)[0], 30 * 2 * k, 8) << k;
  }
  source->seek(5);  // 250 ms: the colour has ended at 125 ms
  Frame frame;
  EXPECT_THAT(source->read(frame, kNoWait).reason, HasSubstr("no colour"));
  EXPECT_TRUE(frame.colour.empty());
}

// To the kind (its first bytes), and for the packets and their checksums.
TEST_F(VideoSourceTest, AFileIsOpenedOnceForItsImages) {
  write_ffv1("f_depth.mkv");
  write_png_packets("p.mkv");
  write_colour("walk.avi");
  for (const char* name : {"f_depth.mkv", "p.mkv", "walk.avi"}) {
    FileWatch watch(path(name));
    const auto source = open_source(path(name).string());
    Frame frame;
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_EQ(watch.closed(), 1) << name;
    EXPECT_EQ(watch.open(), 2) << name;
  }
}

// Every kind of source scales colour by the same function.
TEST_F(VideoSourceTest, SmallColourIsInterpolated) {
  cv::Mat3b small(24, 32);
  for (int row = 0; row < small.rows; ++row)
    for (int col = 0; col < small.cols; ++col)
      small(row, col) =
          cv::Vec3b(static_cast<std::uint8_t>(8 * col), static_cast<std::uint8_t>(10 * row), 128);
  write_png_packets("a_depth.mkv");
  cv::VideoWriter writer(path("a_rgb.avi").string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 20, small.size());
  for (int k = 0; k < kFrames; ++k) writer.write(small);
  writer.release();
  write_file(path("depth_0.png"), encode_png(depth_image(0)));
  write_file(path("rgb_0.png"), encode_png(small));
  Frame decoded, video, image;
  ASSERT_EQ(open_source(path("a_rgb.avi").string())->read(decoded, kNoWait).status, ReadStatus::frame);
  ASSERT_EQ(open_source(path("a_depth.mkv").string())->read(video, kNoWait).status, ReadStatus::frame);
  ASSERT_EQ(open_source(path("depth_0.png").string())->read(image, kNoWait).status, ReadStatus::frame);
  cv::Mat3b expected;
  fit_colour(decoded.colour, kSize, expected);
  EXPECT_EQ(cv::norm(video.colour, expected, cv::NORM_INF), 0);
  fit_colour(small, kSize, expected);
  EXPECT_EQ(cv::norm(image.colour, expected, cv::NORM_INF), 0);
}

TEST_F(VideoSourceTest, BrokenColourBesideLeavesTheDepth) {
  write_ffv1("a_depth.mkv");
  write_file(path("a_rgb.avi"), std::string_view("no video"));
  const auto source = open_source(path("a_depth.mkv").string());
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("no colour: no video that can be read")));
  expect_exact(*source);
}

TEST_F(VideoSourceTest, AColourVideoHasNoDepthAndSaysSo) {
  write_colour("walk.avi", 25);
  const auto source = open_source(path("walk.avi").string());
  EXPECT_FALSE(source->info().has_depth);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("no depth")));
  EXPECT_NEAR(source->info().rate_hz, 25, 1e-6);
  Frame frame;
  for (const int k : {0, 1, 2, 3, 4, 5, 2, 0}) {
    source->seek(k);
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_EQ(frame.index, k);
    EXPECT_EQ(frame.timestamp_us, 40'000 * k);
    EXPECT_NEAR(frame.colour(9, 9)[0], 30 * k, 8);
    EXPECT_EQ(frame.depth_mm.size(), kSize);
    EXPECT_EQ(cv::countNonZero(frame.depth_mm), 0);
  }
  source->seek(kFrames);
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
}

TEST_F(VideoSourceTest, DepthOfEightBitsIsRefusedWithTheReason) {
  write_colour("a_depth.avi");
  EXPECT_THAT(complaint(path("a_depth.avi").string()), HasSubstr("8 bits"));
  EXPECT_THAT(complaint(path("a_depth.avi").string()), HasSubstr("FFV1 gray16le"));
  write_file(path("depth_0000.png"), encode_png(cv::Mat1b(kSize, std::uint8_t{7})));
  EXPECT_THAT(complaint(path("depth_%04d.png").string()), HasSubstr("16-bit grey"));
  // PNGs of 8 bits are colour, unless the name says that they are depth.
  const std::vector<std::vector<std::uint8_t>> packets(3, encode_png(colour_image(1)));
  write_matroska(path("c_depth.mkv"), fourcc("MPNG"), kSize, 24, 50, packets);
  EXPECT_THAT(complaint(path("c_depth.mkv").string()), HasSubstr("8 bits"));
  write_matroska(path("c.mkv"), fourcc("MPNG"), kSize, 24, 50, packets);
  EXPECT_FALSE(open_source(path("c.mkv").string())->info().has_depth);
  EXPECT_THROW(open_source(path("c.mkv").string(), {{}, {.depth_unit_mm = 0.1}}), Error) << "of no effect";
}

TEST_F(VideoSourceTest, UnreadableInputGivesOneLineAndNothingElse) {
  write_file(path("broken.mkv"), std::string_view("this is no video at all, whatever its name may say"));
  write_file(path("empty.mp4"), std::string_view(""));
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(complaint(path("broken.mkv").string()), HasSubstr("no video"));
  EXPECT_THAT(complaint(path("empty.mp4").string()), HasSubstr("no video"));
  EXPECT_THAT(complaint(path("none_%04d.png").string()), HasSubstr("no images"));
  EXPECT_THAT(complaint(path("absent.mkv").string()), HasSubstr("no such source"));
  EXPECT_THAT(complaint("v4l2:/dev/no_such_camera"), HasSubstr("no camera"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace saccade
