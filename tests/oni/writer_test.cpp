#include "oni/writer.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "oni/check.hpp"
#include "oni/recorder.hpp"
#include "oni/recording.hpp"
#include "oni_fixtures.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/outcome.hpp"

namespace saccade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const cv::Size kSize(40, 30);

class OniWriterTest : public OniFiles {};

void expect_sound(const std::filesystem::path& file) {
  Recording recording(file);
  const OniProblems problems = check_recording(recording);
  for (const OniProblem& problem : problems.list())
    ADD_FAILURE() << problem.position << ": " << problem.meaning;
}

TEST_F(OniWriterTest, DepthIsKeptBitForBitInEveryCodec) {
  for (const OniDepthCodec codec : {OniDepthCodec::z16t, OniDepthCodec::z16p, OniDepthCodec::none}) {
    record_test_frames(path("d.oni"), 5, kSize, false, {.depth_codec = codec, .overwrite = true});
    expect_sound(path("d.oni"));
    Recording recording(path("d.oni"));
    const OniNode& node = *main_depth(recording);
    ASSERT_EQ(node.frames.size(), 5u);
    cv::Mat1f depth;
    for (int k = 4; k >= 0; --k) {
      ASSERT_TRUE(succeeded(recording.read_depth(node, static_cast<std::size_t>(k), depth)));
      EXPECT_TRUE(equal(depth, test_frame(k, kSize, false).depth_mm));
      EXPECT_EQ(node.frames[static_cast<std::size_t>(k)].timestamp_us, 33'333u * static_cast<unsigned>(k));
    }
  }
}

TEST_F(OniWriterTest, AFileThatIsReplacedStaysUntilTheFirstFrame) {
  record_test_frames(path("a.oni"), 3, kSize, false);
  const auto before = read_bytes(path("a.oni"));
  {
    OniWriter writer(path("a.oni"), {.overwrite = true});
    EXPECT_EQ(read_bytes(path("a.oni")), before);
    EXPECT_THROW(writer.close(), Error) << "nothing was recorded";
  }
  EXPECT_EQ(read_bytes(path("a.oni")), before);
  {
    OniWriter writer(path("a.oni"), {.overwrite = true});
    writer.write(test_frame(0, kSize, false));
    EXPECT_NE(read_bytes(path("a.oni")), before) << "a process that is killed now has saved its frame";
    writer.close();
  }
  expect_sound(path("a.oni"));
  EXPECT_FALSE(std::filesystem::exists(path("a.oni.part")));
}

TEST_F(OniWriterTest, WhatAKilledProcessLeftBesideIsReplaced) {
  record_test_frames(path("a.oni"), 1, kSize, false);
  write_bytes(path("a.oni.part"), std::vector<std::uint8_t>{1, 2, 3});
  record_test_frames(path("a.oni"), 2, kSize, false, {.overwrite = true});
  EXPECT_EQ(main_depth(Recording(path("a.oni")))->frames.size(), 2u);
  EXPECT_FALSE(std::filesystem::exists(path("a.oni.part")));
}

TEST_F(OniWriterTest, AFileThatIsDeletedMeanwhileIsAnError) {
  OniWriter writer(path("a.oni"), {});
  writer.write(test_frame(0, kSize, false));
  std::filesystem::remove(path("a.oni"));
  EXPECT_THROW(writer.close(), Error);
}

// 65535 stands for no reading, and so cannot be stored as a length.
TEST_F(OniWriterTest, EveryDepthUpTo65534IsKept) {
  Frame frame = test_frame(0, {256, 256}, false);
  for (int i = 0; i < 65536; ++i) frame.depth_mm(i / 256, i % 256) = static_cast<float>(i);
  OniWriter writer(path("all.oni"), {.depth_codec = OniDepthCodec::none});
  writer.write(frame);
  writer.close();
  EXPECT_EQ(writer.counts().rounded, 0u);
  EXPECT_EQ(writer.counts().out_of_range_pixels, 1u);
  Recording recording(path("all.oni"));
  cv::Mat1f depth;
  ASSERT_TRUE(succeeded(recording.read_depth(*main_depth(recording), 0, depth)));
  frame.depth_mm(255, 255) = 0;
  EXPECT_TRUE(equal(depth, frame.depth_mm));
}

// 65534.5 mm and more would be rounded to 65535.
TEST_F(OniWriterTest, DepthThatWouldBecomeTheValueOfNoReadingIsOutOfRange) {
  Frame frame = test_frame(0, kSize, false);
  frame.depth_mm.setTo(1000.0f);
  frame.depth_mm(0, 0) = 65534.49f;
  frame.depth_mm(0, 1) = 65534.5f;
  OniWriter writer(path("far.oni"), {});
  writer.write(frame);
  writer.close();
  EXPECT_EQ(writer.counts().out_of_range_pixels, 1u);
  Recording recording(path("far.oni"));
  cv::Mat1f depth;
  ASSERT_TRUE(succeeded(recording.read_depth(*main_depth(recording), 0, depth)));
  EXPECT_EQ(depth(0, 0), 65534.0f);
  EXPECT_EQ(depth(0, 1), 0.0f);
}

TEST_F(OniWriterTest, TenthsOfAMillimetreAreKept) {
  Frame frame = test_frame(0, kSize, false);
  for (int i = 0; i < frame.size().area(); ++i)
    frame.depth_mm(i / kSize.width, i % kSize.width) = static_cast<float>(7 * i) / 10.0f;
  OniWriter writer(path("fine.oni"), {});
  writer.write(frame);
  writer.close();
  EXPECT_EQ(writer.counts().rounded, 0u);
  Recording recording(path("fine.oni"));
  cv::Mat1f depth;
  ASSERT_TRUE(succeeded(recording.read_depth(*main_depth(recording), 0, depth)));
  EXPECT_TRUE(equal(depth, frame.depth_mm));
}

TEST_F(OniWriterTest, RoundedAndOutOfRangeDepthIsCountedAndNotedInTheFile) {
  Frame frame = test_frame(0, kSize, false);
  frame.depth_mm.setTo(1000.0f);
  frame.depth_mm(0, 0) = 1000.26f;
  frame.depth_mm(0, 1) = 70000.0f;
  OniWriter writer(path("r.oni"), {});
  writer.write(frame);
  frame.depth_mm.setTo(12.0f);
  writer.write(frame);
  writer.close();
  EXPECT_EQ(writer.counts().rounded, 1u);
  EXPECT_NEAR(writer.counts().largest_rounding_mm, 0.26, 1e-3) << "70 m is too far for steps of 0.1 mm";
  EXPECT_EQ(writer.counts().out_of_range_pixels, 1u);
  Recording recording(path("r.oni"));
  EXPECT_EQ(main_depth(recording)->int_property(oni_property::kRounded, recording.index().file_size), 1u);
  cv::Mat1f depth;
  ASSERT_TRUE(succeeded(recording.read_depth(*main_depth(recording), 0, depth)));
  EXPECT_EQ(depth(0, 0), 1000.0f);
  EXPECT_EQ(depth(0, 1), 0.0f);
}

TEST_F(OniWriterTest, RawColourIsExactAndJpegIsClose) {
  for (const OniColourCodec codec : {OniColourCodec::none, OniColourCodec::jpeg}) {
    record_test_frames(path("c.oni"), 2, kSize, true, {.colour_codec = codec, .overwrite = true});
    expect_sound(path("c.oni"));
    Recording recording(path("c.oni"));
    cv::Mat3b colour;
    ASSERT_TRUE(succeeded(recording.read_colour(*main_colour(recording), 1, colour)));
    const double error = cv::norm(colour, test_frame(1, kSize, true).colour, cv::NORM_INF);
    EXPECT_LE(error, codec == OniColourCodec::none ? 0 : 12);
  }
}

TEST_F(OniWriterTest, ColourCanBeOmittedOrStartLater) {
  record_test_frames(path("off.oni"), 2, kSize, true, {.colour_codec = OniColourCodec::off});
  EXPECT_EQ(Recording(path("off.oni")).index().nodes.size(), 1u);
  OniWriter writer(path("late.oni"), {.expect_colour = true});
  writer.write(test_frame(0, kSize, false));
  writer.write(test_frame(1, kSize, true));
  writer.close();
  EXPECT_EQ(writer.counts().colourless, 1u);
  const Recording recording(path("late.oni"));
  EXPECT_EQ(main_colour(recording)->frames.size(), 1u);
}

TEST_F(OniWriterTest, TheCameraAndItsOriginAreKept) {
  const auto camera_of = [&](IntrinsicsOrigin origin) {
    Frame frame = test_frame(0, kSize, false);
    frame.intrinsics.origin = origin;
    OniWriter writer(path("i.oni"), {.overwrite = true});
    writer.write(frame);
    writer.close();
    const Recording recording(path("i.oni"));
    return intrinsics_at(recording.index().nodes[0], recording.index().file_size, kSize).value();
  };
  const Intrinsics camera = camera_of(IntrinsicsOrigin::sensor);
  EXPECT_EQ(std::tuple(camera.fx, camera.fy, camera.cx, camera.cy),
            std::tuple(500.25, 501.5, 20.125, 14.625));
  EXPECT_EQ(camera.origin, IntrinsicsOrigin::file);
  EXPECT_EQ(camera_of(IntrinsicsOrigin::guess).origin, IntrinsicsOrigin::guess)
      << "a written guess stays a guess";
}

TEST_F(OniWriterTest, DropsAreNotedInTheFile) {
  OniWriter writer(path("x.oni"), {});
  writer.write(test_frame(0, kSize, false));
  writer.note_dropped(3);
  writer.write(test_frame(4, kSize, false));
  writer.note_dropped(5);
  writer.close();
  const Recording recording(path("x.oni"));
  const OniNode& node = recording.index().nodes[0];
  EXPECT_EQ(node.int_property(oni_property::kDropped, node.frames[0].payload_position), std::nullopt);
  EXPECT_EQ(node.int_property(oni_property::kDropped, node.frames[1].payload_position), 3u);
  EXPECT_EQ(node.int_property(oni_property::kDropped, recording.index().file_size), 5u);
}

TEST_F(OniWriterTest, ATimeBeforeTheFirstIsTheFirst) {
  OniWriter writer(path("t.oni"), {});
  Frame frame = test_frame(0, kSize, false);
  for (const std::int64_t time_us : {100'000, 40'000, 160'000}) {
    frame.timestamp_us = time_us;
    writer.write(frame);
  }
  writer.close();
  const Recording recording(path("t.oni"));
  std::vector<std::uint64_t> times;
  for (const OniFrameEntry& entry : main_depth(recording)->frames) times.push_back(entry.timestamp_us);
  EXPECT_THAT(times, ElementsAre(0, 0, 60'000));
}

TEST_F(OniWriterTest, AnExistingFileIsReplacedOnlyOnRequest) {
  write_bytes(path("precious"), std::vector<std::uint8_t>{1, 2, 3});
  EXPECT_THROW(OniWriter(path("precious"), {}), Error);
  EXPECT_EQ(read_bytes(path("precious")).size(), 3u);
  record_test_frames(path("precious"), 1, kSize, false, {.overwrite = true});
  expect_sound(path("precious"));
}

TEST_F(OniWriterTest, AFileWithoutFramesIsRemoved) {
  OniWriter writer(path("none.oni"), {});
  EXPECT_THROW(writer.close(), Error);
  EXPECT_FALSE(std::filesystem::exists(path("none.oni")));
}

TEST_F(OniWriterTest, AnotherSizeIsRefused) {
  OniWriter writer(path("s.oni"), {});
  writer.write(test_frame(0, kSize, false));
  EXPECT_THROW(writer.write(test_frame(1, {20, 30}, false)), Error);
  writer.close();
  expect_sound(path("s.oni"));
}

TEST_F(OniWriterTest, OnAFullDiskTheFileIsClosedWithAllFramesBefore) {
  for (const rlim_t most_bytes : {20'000U, 400'000U}) {  // the table of many frames needs room, too
    SCOPED_TRACE(most_bytes);
    const FileSizeLimit limit(most_bytes);
    OniWriter writer(path("full.oni"), {.depth_codec = OniDepthCodec::none, .overwrite = true});
    std::string error;
    std::size_t written = 0;
    for (int k = 0; k < 1000 && error.empty(); ++k) try {
        Frame frame = test_frame(k % 50, kSize, false);
        frame.timestamp_us = 33'333 * k;
        writer.write(frame);
        ++written;
      } catch (const Error& full) {
        error = full.what();
      }
    EXPECT_THAT(error, HasSubstr("disk full"));
    EXPECT_THAT(error,
                HasSubstr("the file is closed with the " + std::to_string(written) + " frames before"));
    EXPECT_GT(written, most_bytes / 5000);
    EXPECT_LE(std::filesystem::file_size(path("full.oni")), most_bytes);
    expect_sound(path("full.oni"));
    const Recording recording(path("full.oni"));
    EXPECT_EQ(main_depth(recording)->frames.size(), written);
  }
}

TEST_F(OniWriterTest, TheRecorderWritesAcceptedFramesAndCountsTheOthers) {
  OniWriter writer(path("q.oni"), {});
  std::size_t taken = 0;
  {
    OniRecorder recorder(writer, 2);
    for (int k = 0; k < 200; ++k) taken += recorder.offer(test_frame(k, kSize, true)) ? 1 : 0;
    recorder.push(test_frame(200, kSize, true));
    recorder.finish();
    EXPECT_EQ(recorder.counts().frames, taken + 1);
    EXPECT_EQ(recorder.counts().dropped, 200 - taken);
  }
  expect_sound(path("q.oni"));
  Recording recording(path("q.oni"));
  const OniNode& node = *main_depth(recording);
  ASSERT_EQ(node.frames.size(), taken + 1);
  EXPECT_EQ(node.int_property(oni_property::kDropped, recording.index().file_size).value_or(0), 200 - taken);
  cv::Mat1f depth;
  ASSERT_TRUE(succeeded(recording.read_depth(node, taken, depth)));
  EXPECT_TRUE(equal(depth, test_frame(200, kSize, true).depth_mm)) << "queued frames are copies";
}

TEST_F(OniWriterTest, AnErrorOfTheWritingThreadReachesTheCaller) {
  OniWriter writer(path("e.oni"), {});
  OniRecorder recorder(writer, 2);
  recorder.push(test_frame(0, kSize, false));
  recorder.push(test_frame(1, {8, 8}, false));
  EXPECT_THROW(recorder.finish(), Error);
  EXPECT_THROW(recorder.push(test_frame(2, kSize, false)), Error);
  expect_sound(path("e.oni"));
}

}  // namespace
}  // namespace saccade
