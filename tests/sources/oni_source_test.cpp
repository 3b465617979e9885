#include "sources/oni_source.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "oni/bytes.hpp"
#include "oni/writer.hpp"
#include "sources/open_source.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kRecorded = 10;

class OniSourceTest : public FolderTest {
 protected:
  fs::path file() const { return folder_ / "r.oni"; }

  static Frame frame(int k) {
    Frame frame;
    frame.timestamp_us = 5000 + 33'333LL * k;
    frame.intrinsics = {300, 301, 15.25, 11.75, IntrinsicsOrigin::sensor};
    frame.depth_mm = cv::Mat1f(24, 32, static_cast<float>(1000 + k));
    frame.colour = cv::Mat3b(24, 32, cv::Vec3b(static_cast<std::uint8_t>(10 * k), 100, 200));
    return frame;
  }

  void record(OniWriterOptions options = {.colour_codec = OniColourCodec::none}) const {
    OniWriter writer(file(), options);
    for (int k = 0; k < kRecorded; ++k) writer.write(frame(k));
    writer.close();
  }

  // Overwrites part of the recording.
  void damage(std::uint64_t position, std::vector<std::uint8_t> bytes) const {
    const int descriptor = ::open(file().c_str(), O_WRONLY);
    EXPECT_EQ(::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(position)),
              static_cast<ssize_t>(bytes.size()));
    ::close(descriptor);
  }
};

void expect_frame(const Frame& frame, int k) {
  EXPECT_EQ(frame.index, k);
  EXPECT_EQ(frame.timestamp_us, 33'333 * k);
  EXPECT_EQ(cv::norm(frame.depth_mm, cv::Mat1f(24, 32, static_cast<float>(1000 + k)), cv::NORM_INF), 0);
  EXPECT_EQ(frame.colour(3, 4), cv::Vec3b(static_cast<std::uint8_t>(10 * k), 100, 200));
  EXPECT_EQ(frame.intrinsics.fx, 300);
}

TEST_F(OniSourceTest, GivesEveryFrameWithColourTimeAndCamera) {
  record();
  const auto source = open_source(file().string());
  EXPECT_EQ(source->info().kind, "oni");
  EXPECT_EQ(source->info().frame_count, kRecorded);
  EXPECT_EQ(source->info().size, cv::Size(32, 24));
  EXPECT_EQ(source->info().rate_hz, 30);
  EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::file);
  EXPECT_TRUE(source->info().notes.empty());
  Frame frame;
  for (int k = 0; k < kRecorded; ++k) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    expect_frame(frame, k);
  }
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
}

TEST_F(OniSourceTest, SeekingGivesTheFramesOfTheSequence) {
  record();
  OniSource source(file());
  Frame frame;
  for (const int k : {7, 0, 9, 3, 4, 3}) {
    source.seek(k);
    ASSERT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
    expect_frame(frame, k);
  }
  source.seek(kRecorded);
  EXPECT_EQ(source.read(frame, kNoWait).status, ReadStatus::end);
}

TEST_F(OniSourceTest, ADamagedFrameIsRejectedAndTheNextIsGood) {
  record();
  {
    const Recording recording(file());
    damage(main_depth(recording)->frames[4].payload_position, {0, 0});  // a table of no values
  }
  OniSource source(file());
  Frame frame;
  source.seek(4);
  const ReadResult result = source.read(frame, kNoWait);
  EXPECT_EQ(result.status, ReadStatus::rejected);
  EXPECT_THAT(result.reason, HasSubstr("table"));
  ASSERT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
  expect_frame(frame, 5);
}

TEST_F(OniSourceTest, DamagedColourCostsTheColourOnly) {
  record({});
  {
    const Recording recording(file());
    damage(main_colour(recording)->frames[2].payload_position, {0, 0});
  }
  OniSource source(file());
  Frame frame;
  for (int k = 0; k < kRecorded; ++k) {
    const ReadResult result = source.read(frame, kNoWait);
    ASSERT_EQ(result.status, ReadStatus::frame);
    EXPECT_EQ(frame.colour.empty(), k == 2);
    EXPECT_EQ(result.reason.empty(), k != 2);
  }
}

TEST_F(OniSourceTest, LossesAreNotes) {
  record();
  fs::resize_file(file(), fs::file_size(file()) * 2 / 3);
  const OniSource source(file());
  EXPECT_LT(*source.info().frame_count, kRecorded);
  EXPECT_THAT(source.info().notes, Contains(HasSubstr("not closed")));
}

TEST_F(OniSourceTest, AGuessedCameraStaysAGuess) {
  OniWriter writer(file(), {});
  Frame guessed = frame(0);
  guessed.intrinsics.origin = IntrinsicsOrigin::guess;
  writer.write(guessed);
  writer.close();
  const OniSource source(file());
  EXPECT_EQ(source.info().intrinsics.origin, IntrinsicsOrigin::guess);
  EXPECT_EQ(source.info().intrinsics.fx, 300);
}

TEST_F(OniSourceTest, ColourOfAnotherSizeIsScaledWithANote) {
  OniRecordWriter writer(file(), false);
  const auto add = [&](std::uint32_t id, OniNodeType type, OniPixelFormat pixels, std::uint32_t width) {
    OniNodeFields fields;
    fields.name = "x";
    fields.type = type;
    fields.codec = OniCodec::none;
    writer.add_node(id, fields);
    std::array<std::uint8_t, 12> mode{};
    store_le(&mode[0], width);
    store_le(&mode[4], std::uint32_t{2});
    store_le(&mode[8], std::uint32_t{30});
    writer.add_property(id, OniRecordType::general_property, oni_property::kMode, mode);
    writer.add_int(id, oni_property::kOniFormat, static_cast<std::uint64_t>(pixels));
  };
  add(1, OniNodeType::depth, OniPixelFormat::depth_1mm, 2);
  add(2, OniNodeType::ir, OniPixelFormat::grey8, 4);
  writer.begin();
  ASSERT_TRUE(writer.write_frame(1, 0, std::vector<std::uint8_t>(8, 1)));
  ASSERT_TRUE(writer.write_frame(2, 24'000, std::vector<std::uint8_t>(8, 77)));
  ASSERT_TRUE(writer.write_frame(1, 66'000, std::vector<std::uint8_t>(8, 1)));
  writer.close();
  OniSource source(file());
  EXPECT_THAT(source.info().notes, Contains(HasSubstr("infrared")));
  EXPECT_THAT(source.info().notes, Contains(HasSubstr("4 x 2 is scaled to the depth's 2 x 2")));
  EXPECT_THAT(source.info().notes, Contains(HasSubstr("calibration")));
  Frame frame;
  ASSERT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
  ASSERT_EQ(frame.colour.size(), cv::Size(2, 2));
  EXPECT_EQ(frame.colour(1, 1), cv::Vec3b(77, 77, 77));
  ASSERT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_TRUE(frame.colour.empty()) << "42 ms away is another moment";
}

// A recording of three frames of depth and colour with these times.
void write_streams(const fs::path& file, std::uint64_t depth_step_us, std::uint64_t colour_begin_us,
                   std::uint64_t colour_step_us) {
  OniRecordWriter writer(file, true);
  for (const std::uint32_t id : {1U, 2U}) {
    OniNodeFields fields;
    fields.name = id == 1 ? "Depth" : "Image";
    fields.type = id == 1 ? OniNodeType::depth : OniNodeType::image;
    fields.codec = OniCodec::none;
    writer.add_node(id, fields);
    std::array<std::uint8_t, 12> mode{};
    store_le(&mode[0], std::uint32_t{2});
    store_le(&mode[4], std::uint32_t{2});
    store_le(&mode[8], std::uint32_t{30});
    writer.add_property(id, OniRecordType::general_property, oni_property::kMode, mode);
    writer.add_int(id, oni_property::kOniFormat,
                   static_cast<std::uint64_t>(id == 1 ? OniPixelFormat::depth_1mm : OniPixelFormat::rgb888));
  }
  writer.begin();
  for (std::uint8_t k = 0; k < 3; ++k) {
    ASSERT_TRUE(writer.write_frame(1, k * depth_step_us, std::vector<std::uint8_t>(8, 1)));
    ASSERT_TRUE(
        writer.write_frame(2, colour_begin_us + k * colour_step_us, std::vector<std::uint8_t>(12, k)));
  }
  writer.close();
}

TEST_F(OniSourceTest, WhereTimesDoNotFitColourIsPairedByOrder) {
  struct Case {
    const char* what;
    std::uint64_t depth_step_us, colour_begin_us, colour_step_us;
  };
  for (const Case& c : {Case{"all times are zero", 0, 0, 0}, Case{"depth has no times", 0, 0, 33'333},
                        Case{"colour has no times", 33'333, 0, 0},
                        Case{"the clocks differ", 33'333, 9'000'000'000, 33'333}}) {
    SCOPED_TRACE(c.what);
    write_streams(file(), c.depth_step_us, c.colour_begin_us, c.colour_step_us);
    OniSource source(file());
    EXPECT_THAT(source.info().notes, Contains(HasSubstr("paired by their order")));
    Frame frame;
    for (std::uint8_t k = 0; k < 3; ++k) {
      ASSERT_EQ(source.read(frame, kNoWait).status, ReadStatus::frame);
      ASSERT_FALSE(frame.colour.empty());
      EXPECT_EQ(frame.colour(0, 0)[0], k);
      EXPECT_NEAR(static_cast<double>(frame.timestamp_us), k * 1e6 / 30, 1);
    }
  }
}

TEST_F(OniSourceTest, WithoutDepthItIsUnreadable) {
  OniRecordWriter writer(file(), false);
  OniNodeFields fields;
  fields.name = "Image";
  fields.type = OniNodeType::image;
  fields.codec = OniCodec::jpeg;
  writer.add_node(1, fields);
  writer.begin();
  writer.close();
  try {
    const OniSource source(file());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::unreadable);
    EXPECT_THAT(error.what(), HasSubstr("no depth frames"));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

}  // namespace
}  // namespace saccade
