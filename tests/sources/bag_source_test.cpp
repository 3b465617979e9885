// Recordings of ROS, by writers of our own.
#include <filesystem>
#include <random>

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "bag_writer.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/fit_colour.hpp"
#include "core/png.hpp"
#include "sources/open_source.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/no_wait.hpp"
#include "tests/support/places.hpp"
#include "tests/support/subprocess.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kBegin_ns = 1'700'000'000'000'000'000;
const Intrinsics kBagCamera{500.5, 501.5, 8.25, 5.75, IntrinsicsOrigin::file};
const std::string kDepth = "/camera/depth/image_raw", kColour = "/camera/color/image_raw";

cv::Mat1w bag_depth(int k) {
  cv::Mat1w image(12, 16);
  for (int i = 0; i < 192; ++i) image(i / 16, i % 16) = static_cast<std::uint16_t>(1000 + 10 * k + i);
  image(0, 0) = 0;
  image(0, 1) = 65535;
  return image;
}

cv::Mat3b bag_colour(int k) { return cv::Mat3b(12, 16, cv::Vec3b(10, 20, static_cast<std::uint8_t>(k))); }

std::int64_t stamp(int k) { return kBegin_ns + k * std::int64_t{33'333'000}; }

// Four frames; colour is 5 ms later, and missing at frame 2.
std::vector<TestMessage> recording(bool cdr) {
  const MessageWriter writer(cdr);
  std::vector<TestMessage> messages = {
      writer.camera("/camera/depth/camera_info", stamp(0), {16, 12}, kBagCamera),
      writer.camera("/camera/color/camera_info", stamp(0), {16, 12}, {1, 1, 1, 1, IntrinsicsOrigin::file})};
  for (int k = 0; k < 4; ++k) {
    messages.push_back(writer.image(kDepth, stamp(k), bag_depth(k), "16UC1"));
    if (k != 2) messages.push_back(writer.image(kColour, stamp(k) + 5'000'000, bag_colour(k), "bgr8"));
  }
  return messages;
}

class BagSourceTest : public FolderTest {
 protected:
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  void expect_recording(const std::string& file) const {
    SCOPED_TRACE(file);
    const auto source = open_source(file);
    EXPECT_EQ(source->info().frame_count, 4);
    EXPECT_EQ(source->info().intrinsics.fx, kBagCamera.fx);
    EXPECT_EQ(source->info().intrinsics.cy, kBagCamera.cy);
    EXPECT_NEAR(source->info().rate_hz, 30, 0.01);
    for (const int k : {0, 1, 2, 3, 0}) {
      source->seek(k);
      Frame frame;
      const ReadResult result = source->read(frame, kNoWait);
      ASSERT_EQ(result.status, ReadStatus::frame) << result.reason;
      EXPECT_EQ(frame.timestamp_us, stamp(k) / 1000);
      cv::Mat1f expected;
      bag_depth(k).convertTo(expected, CV_32F);
      expected(0, 1) = 0;
      EXPECT_EQ(cv::norm(frame.depth_mm, expected, cv::NORM_INF), 0);
      ASSERT_EQ(frame.colour.empty(), k == 2);
      if (k != 2) {
        EXPECT_EQ(cv::norm(frame.colour, bag_colour(k), cv::NORM_INF), 0);
      }
    }
  }

  std::string complaint(const std::string& file, ExitStatus status,
                        const InputSettings& settings = {}) const {
    return error_of(status, [&] { open_source(file, {{}, settings}); });
  }
};

TEST_F(BagSourceTest, EveryContainerAndCompressionGivesTheSameFrames) {
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    write_ros1_bag(folder_ / (compression + ".bag"), recording(false), compression);
    expect_recording(in(compression + ".bag"));
  }
  for (const std::string compression : {"", "lz4", "zstd"}) {
    write_mcap(folder_ / ("a" + compression + ".mcap"), recording(true), compression);
    expect_recording(in("a" + compression + ".mcap"));
  }
  write_plain_mcap(folder_ / "plain.mcap", recording(true));
  expect_recording(in("plain.mcap"));
  write_db3(folder_ / "a.db3", recording(true));
  expect_recording(in("a.db3"));
  fs::create_directory(folder_ / "ros2");
  fs::copy(folder_ / "a.db3", folder_ / "ros2/a_0.db3");
  write_file(folder_ / "ros2/metadata.yaml", std::string_view("rosbag2_bagfile_information:\n"));
  expect_recording(in("ros2"));
}

// Recorders write messages as they arrive.
TEST_F(BagSourceTest, FramesComeInTheOrderOfTheirTimesNotOfTheFile) {
  for (const bool cdr : {false, true}) {
    auto messages = recording(cdr);
    std::ranges::reverse(messages);
    cdr ? write_mcap(folder_ / "a.mcap", messages, "") : write_ros1_bag(folder_ / "a.bag", messages, "none");
    expect_recording(in(cdr ? "a.mcap" : "a.bag"));
  }
}

// Some drivers leave the stamp at 0.
TEST_F(BagSourceTest, WithoutAStampTheTimeIsThatOfTheRecorder) {
  for (const char* name : {"a.bag", "a.mcap", "p.mcap", "a.db3"}) {
    const std::string file = name;
    TestMessage message = MessageWriter(file != "a.bag").image(kDepth, 0, bag_depth(0), "16UC1");
    message.time_ns = kBegin_ns + 123'456'789;
    if (file == "a.bag") write_ros1_bag(folder_ / file, {message}, "none");
    if (file == "a.mcap") write_mcap(folder_ / file, {message}, "lz4");
    if (file == "p.mcap") write_plain_mcap(folder_ / file, {message});
    if (file == "a.db3") write_db3(folder_ / file, {message});
    Frame frame;
    ASSERT_EQ(open_source(in(file))->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_EQ(frame.timestamp_us, kBegin_ns / 1000 + 123'456) << file;
  }
}

TEST_F(BagSourceTest, TheRateIsThatOfTheMessagesThatAreNotMissing) {
  const MessageWriter writer(true);
  std::vector<TestMessage> messages;
  for (const int k : {0, 1, 2, 3, 6, 9, 12})
    messages.push_back(writer.image(kDepth, stamp(k), bag_depth(k), "16UC1"));
  write_mcap(folder_ / "a.mcap", messages, "");
  EXPECT_NEAR(open_source(in("a.mcap"))->info().rate_hz, 30, 0.01);
}

// Every third depth image has a colour image of its moment; the others take the nearest, a period away.
TEST_F(BagSourceTest, ColourMayBeSlowerThanDepth) {
  const MessageWriter writer(true);
  std::vector<TestMessage> messages;
  for (int k = 0; k < 7; ++k) {
    messages.push_back(writer.image(kDepth, stamp(k), bag_depth(k), "16UC1"));
    if (k % 3 == 0) messages.push_back(writer.image(kColour, stamp(k), bag_colour(k), "bgr8"));
  }
  write_mcap(folder_ / "a.mcap", messages, "");
  const auto source = open_source(in("a.mcap"));
  for (const int nearest : {0, 0, 3, 3, 3, 6, 6}) {
    Frame frame;
    const ReadResult read = source->read(frame, kNoWait);
    ASSERT_EQ(read.status, ReadStatus::frame);
    ASSERT_FALSE(frame.colour.empty()) << read.reason;
    EXPECT_EQ(frame.colour(5, 5), bag_colour(nearest)(5, 5));
  }
}

// A second opinion: bags by ROS 1's own library.
TEST_F(BagSourceTest, BagsOfTheReferenceWriterAreRead) {
  constexpr const char* kPython = "/usr/bin/python3";
  if (run_program(kPython, {"-c", "import rosbag, sensor_msgs, numpy"}).status != 0)
    GTEST_SKIP() << "python3-rosbag, python3-sensor-msgs or python3-numpy is not installed";
  for (const char* compression : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    const ProgramResult written =
        run_program(kPython, {in_source("tests/sources/write_bag.py"), in("ros.bag"), compression});
    ASSERT_EQ(written.status, 0) << written.err;
    const auto source = open_source(in("ros.bag"));
    EXPECT_EQ(source->info().frame_count, 3);
    EXPECT_EQ(source->info().intrinsics.fy, 501.5);
    EXPECT_EQ(source->info().intrinsics.cx, 8.25);
    for (int k = 0; k < 3; ++k) {
      Frame frame;
      ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
      EXPECT_NEAR(static_cast<double>(frame.timestamp_us - 1'700'000'000'000'000), k * 1e6 / 30, 1);
      for (int i = 0; i < 192; ++i)
        ASSERT_EQ(frame.depth_mm(i / 16, i % 16), i == 0 ? 0.0F : static_cast<float>(1000 + 100 * k + i));
      EXPECT_EQ(frame.colour(5, 5), cv::Vec3b(static_cast<std::uint8_t>(k), 20, 10));
    }
  }
}

TEST_F(BagSourceTest, OtherEncodingsAreRead) {
  const MessageWriter writer(true);
  cv::Mat1f metres(12, 16, 1.25F);
  metres(0, 0) = std::numeric_limits<float>::quiet_NaN();
  metres(0, 1) = -1;
  std::vector<std::uint8_t> jpeg, packed(12, 0);
  cv::imencode(".jpg", bag_colour(7), jpeg);
  const auto png = encode_png(bag_depth(0));
  packed.insert(packed.end(), png.begin(), png.end());
  write_mcap(
      folder_ / "float.mcap",
      {writer.image("/depth", 5, metres, "32FC1"), writer.compressed("/rgb/compressed", 5, "jpeg", jpeg)},
      "zstd");
  write_mcap(folder_ / "packed.mcap",
             {writer.compressed("/depth/compressedDepth", 5, "16UC1; compressedDepth", packed)}, "");
  Frame frame;
  const auto source = open_source(in("float.mcap"));
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(0, 0), 0);
  EXPECT_EQ(frame.depth_mm(0, 1), 0);
  EXPECT_EQ(frame.depth_mm(5, 5), 1250);
  EXPECT_NEAR(frame.colour(5, 5)[1], 20, 3);
  EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::guess);
  ASSERT_EQ(open_source(in("packed.mcap"))->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(5, 5), static_cast<float>(bag_depth(0)(5, 5)));
}

TEST_F(BagSourceTest, DepthAsACompressedImageIsRead) {
  const MessageWriter writer(false);
  write_ros1_bag(folder_ / "a.bag",
                 {writer.compressed("/depth/image_raw/compressed", 5, "16UC1; png compressed ",
                                    encode_png(bag_depth(2)))},
                 "none");
  Frame frame;
  ASSERT_EQ(open_source(in("a.bag"))->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(5, 5), static_cast<float>(bag_depth(2)(5, 5)));
  EXPECT_EQ(frame.depth_mm(0, 1), 0);
}

std::vector<std::uint8_t> rvl_message(const cv::Mat1w& image) {
  std::vector<std::uint8_t> data(12, 0);
  for (const int size : {image.cols, image.rows})
    for (const int shift : {0, 8, 16, 24}) data.push_back(static_cast<std::uint8_t>(size >> shift));
  const auto packed = encode_rvl(image);
  data.insert(data.end(), packed.begin(), packed.end());
  return data;
}

TEST_F(BagSourceTest, DepthCompressedWithRvlIsExact) {
  const MessageWriter writer(true);
  std::mt19937 random(3);
  cv::Mat1w image(48, 64);
  for (std::uint16_t& value : image)
    value = static_cast<std::uint16_t>(random() % 3 == 0 ? 0 : random() % 65535);
  for (const bool empty : {false, true}) {
    if (empty) image.setTo(0);
    write_mcap(folder_ / "rvl.mcap",
               {writer.compressed("/depth", 5, "16UC1; compressedDepth rvl", rvl_message(image))}, "zstd");
    Frame frame;
    ASSERT_EQ(open_source(in("rvl.mcap"))->read(frame, kNoWait).status, ReadStatus::frame);
    cv::Mat1f expected;
    image.convertTo(expected, CV_32F);
    EXPECT_EQ(cv::norm(frame.depth_mm, expected, cv::NORM_INF), 0);
  }
}

TEST_F(BagSourceTest, DamagedRvlIsRejectedWithTheReason) {
  const MessageWriter writer(true);
  const auto sound = rvl_message(bag_depth(0));
  auto cut = sound, endless = sound, long_run = sound, huge = sound;
  cut.resize(sound.size() / 2 / 4 * 4);
  std::fill(endless.begin() + 20, endless.end(), std::uint8_t{0xff});
  std::fill(long_run.begin() + 20, long_run.begin() + 24, std::uint8_t{0x77});
  std::fill(huge.begin() + 12, huge.begin() + 20, std::uint8_t{0x7f});
  std::vector<TestMessage> messages;
  std::int64_t stamp_ns = 0;
  for (const auto& data : {sound, cut, endless, long_run, huge, std::vector<std::uint8_t>(13)})
    messages.push_back(
        writer.compressed("/depth", stamp_ns += 1'000'000, "16UC1; compressedDepth rvl", data));
  write_plain_mcap(folder_ / "rvl.mcap", messages);
  const auto source = open_source(in("rvl.mcap"));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  for (const char* reason : {"ends early", "does not end", "more pixels", "pixels", "too short"}) {
    const ReadResult result = source->read(frame, kNoWait);
    EXPECT_EQ(result.status, ReadStatus::rejected);
    EXPECT_THAT(result.reason, HasSubstr(reason));
  }
}

// OpenCV throws an exception of its own at rows that begin in the middle of a number.
TEST_F(BagSourceTest, RowsOfHalfNumbersAreRejected) {
  const MessageWriter writer(false);
  const cv::Mat1w depth(20, 24, std::uint16_t{1000});
  TestMessage odd = writer.image("/depth", 2'000'000, depth, "16UC1");
  const std::size_t step =
      odd.bytes.size() - depth.total() * 2 - 8;  // then the number of bytes of the pixels
  ASSERT_EQ(odd.bytes.at(step), 48);
  odd.bytes[step] = 47;
  write_ros1_bag(folder_ / "odd.bag", {writer.image("/depth", 1'000'000, depth, "16UC1"), odd}, "none");
  const auto source = open_source(in("odd.bag"));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  const ReadResult result = source->read(frame, kNoWait);
  EXPECT_EQ(result.status, ReadStatus::rejected);
  EXPECT_THAT(result.reason, HasSubstr("a row of 47 bytes ends within a number"));
}

// Messages in three parts: the topics of a part may have other numbers, or be missing.
TEST_F(BagSourceTest, ASplitRecordingIsOne) {
  const auto all = recording(true);
  for (const bool database : {false, true}) {
    const std::string folder = database ? "split_db3" : "split_mcap";
    fs::create_directory(folder_ / folder);
    write_file(folder_ / folder / "metadata.yaml", std::string_view("rosbag2_bagfile_information:\n"));
    const auto part = [&](int number) {
      return folder_ / folder / ("walk_" + std::to_string(number) + (database ? ".db3" : ".mcap"));
    };
    const auto write = [&](int number, std::ptrdiff_t begin, std::ptrdiff_t end) {
      const std::vector<TestMessage> messages(all.begin() + begin, all.begin() + end);
      database ? write_db3(part(number), messages) : write_mcap(part(number), messages, "lz4");
    };
    write(9, 0, 3);
    write(10, 3, 7);
    write(11, 7, std::ssize(all));
    expect_recording(in(folder));
    // Without one of them, the others.
    write_file(part(10), std::string_view("not a bag"));
    const auto source = open_source(in(folder));
    EXPECT_EQ(source->info().frame_count, 2);
    EXPECT_THAT(source->info().notes, Contains(HasSubstr("walk_10")));
  }
}

class BagCameraTest : public BagSourceTest {
 protected:
  std::unique_ptr<FrameSource> open(const std::string& topic, cv::Size size, const TestLens& lens) const {
    const MessageWriter writer(true);
    write_mcap(folder_ / "camera.mcap",
               {writer.camera("/depth/camera_info", 5, size, {400, 410, 7, 5, IntrinsicsOrigin::file}, lens),
                writer.image(topic, 5, bag_depth(0), "16UC1")},
               "");
    return open_source(in("camera.mcap"));
  }
  static constexpr Intrinsics kRectified{390, 395, 7.5, 5.5, IntrinsicsOrigin::file};
};

TEST_F(BagCameraTest, DistortionThatStaysIsSaid) {
  EXPECT_THAT(open("/depth/image_raw", {16, 12}, {})->info().notes, Not(Contains(HasSubstr("distortion"))));
  // k1 moves the corner, 10 px from the centre, by k1 r2 of that, r2 = (8/400)^2 + (6/410)^2 = 0.00061.
  const TestLens strong{.distortion = {1000, 0, 0, 0, 0}, .rectified = kRectified};
  const auto raw = open("/depth/image_raw", {16, 12}, strong);
  EXPECT_EQ(raw->info().intrinsics.fx, 400);
  EXPECT_THAT(raw->info().notes,
              Contains("the distortion of the depth camera's lens stays in the depth; at the "
                       "border it is up to 6 pixels"));
  const TestLens fisheye{.model = "equidistant", .distortion = {0.1, 0, 0, 0}};
  EXPECT_THAT(open("/depth/image_raw", {16, 12}, fisheye)->info().notes,
              Contains("the distortion of the depth camera's lens (equidistant) stays in the depth"));
}

TEST_F(BagCameraTest, RectifiedDepthHasAnotherCamera) {
  const TestLens lens{.distortion = {1000, 0, 0, 0, 0}, .rectified = kRectified};
  const auto source = open("/depth/image_rect_raw", {16, 12}, lens);
  EXPECT_EQ(source->info().intrinsics.fx, kRectified.fx);
  EXPECT_EQ(source->info().intrinsics.fy, kRectified.fy);
  EXPECT_EQ(source->info().intrinsics.cx, kRectified.cx);
  EXPECT_EQ(source->info().intrinsics.cy, kRectified.cy);
  EXPECT_THAT(source->info().notes, Not(Contains(HasSubstr("distortion"))));
  EXPECT_EQ(open("/depth/image_rect", {16, 12}, {})->info().intrinsics.fx, 400) << "it names none";
}

TEST_F(BagCameraTest, TheCameraIsThatOfTheImages) {
  // Every second pixel of the 32 x 24 that begin at (3, 1).
  const auto binned = open("/depth/image_raw", {64, 48}, {.binning = 2, .part = {3, 1, 32, 24}});
  EXPECT_EQ(binned->info().intrinsics.fx, 200);
  EXPECT_EQ(binned->info().intrinsics.cx, (7 - 3 + 0.5) / 2 - 0.5);
  EXPECT_EQ(binned->info().intrinsics.cy, (5 - 1 + 0.5) / 2 - 0.5);
  const auto scaled = open("/depth/image_raw", {32, 24}, {});
  EXPECT_EQ(scaled->info().intrinsics.fy, 205);
  EXPECT_THAT(scaled->info().notes, Contains(HasSubstr("is of images of 32 x 24 and is scaled")));
  const auto other = open("/depth/image_raw", {32, 18}, {});
  EXPECT_EQ(other->info().intrinsics.origin, IntrinsicsOrigin::guess);
  EXPECT_THAT(other->info().notes, Contains(HasSubstr("not used: it is of images of 32 x 18")));
}

TEST_F(BagSourceTest, TheUnitOfTheUserHoldsForFloatsToo) {
  const MessageWriter writer(true);
  write_mcap(folder_ / "a.mcap", {writer.image("/depth", 5, cv::Mat1f(12, 16, 1500.0F), "32FC1")}, "");
  Frame frame;
  const auto source = open_source(in("a.mcap"), {{}, {.depth_unit_mm = 2}});
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(5, 5), 3000);
  write_mcap(folder_ / "b.mcap", {writer.image("/depth", 5, bag_depth(0), "mono16")}, "");
  ASSERT_EQ(open_source(in("b.mcap"), {{}, {.depth_unit_mm = 2}})->read(frame, kNoWait).status,
            ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(5, 5), 2.0F * bag_depth(0)(5, 5));
}

TEST_F(BagSourceTest, SmallColourIsInterpolatedAsInEverySource) {
  const MessageWriter writer(true);
  cv::Mat3b small(3, 4);
  for (int i = 0; i < 12; ++i) small(i / 4, i % 4) = cv::Vec3b::all(static_cast<std::uint8_t>(20 * i));
  write_mcap(folder_ / "a.mcap",
             {writer.image(kDepth, 5, bag_depth(0), "16UC1"), writer.image(kColour, 5, small, "bgr8")}, "");
  Frame frame;
  ASSERT_EQ(open_source(in("a.mcap"))->read(frame, kNoWait).status, ReadStatus::frame);
  cv::Mat3b expected;
  fit_colour(small, {16, 12}, expected);
  EXPECT_EQ(cv::norm(frame.colour, expected, cv::NORM_INF), 0);
}

// The recorder of ROS 2 can compress whole files and single messages, which are not read.
TEST_F(BagSourceTest, OtherCompressionOfRos2IsOneLine) {
  fs::create_directory(folder_ / "files");
  write_file(folder_ / "files/metadata.yaml", std::string_view("rosbag2_bagfile_information:\n"));
  write_file(folder_ / "files/a_0.mcap.zstd", std::string_view("x"));
  for (const std::string& source : {in("files"), in("files/a_0.mcap.zstd")})
    EXPECT_THAT(complaint(source, ExitStatus::unreadable),
                AllOf(HasSubstr("compressed as a whole"), HasSubstr("zstd -d")));
  write_mcap(folder_ / "files/a_0.mcap", recording(true), "");
  EXPECT_EQ(open_source(in("files"))->info().frame_count, 4) << "it has been decompressed";
  TestMessage message = MessageWriter(true).image(kDepth, 5, bag_depth(0), "16UC1");
  message.bytes.insert(message.bytes.begin(), {0x28, 0xB5, 0x2F, 0xFD});
  write_db3(folder_ / "a.db3", {message});
  EXPECT_THAT(complaint(in("a.db3"), ExitStatus::unreadable),
              HasSubstr("its messages are compressed one by one"));
}

TEST_F(BagSourceTest, TopicsAreChosenByNameOrByTheUser) {
  const MessageWriter writer(false);
  std::vector<TestMessage> messages = {writer.image("/a/depth/image", 5, bag_depth(0), "16UC1"),
                                       writer.image("/b/depth/image", 5, bag_depth(3), "16UC1")};
  write_ros1_bag(folder_ / "two.bag", messages, "none");
  EXPECT_THAT(complaint(in("two.bag"), ExitStatus::unreadable),
              HasSubstr("choose with --topics depth=TOPIC: /a/depth/image, /b/depth/image"));
  Frame frame;
  const auto chosen = open_source(in("two.bag"), {{}, {.depth_topic = "/b/depth/image"}});
  ASSERT_EQ(chosen->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(5, 5), static_cast<float>(bag_depth(3)(5, 5)));
  EXPECT_THAT(complaint(in("two.bag"), ExitStatus::usage, {.depth_topic = "/c"}),
              HasSubstr("no topic of this name has depth: --topics depth=/c"));
  messages.push_back(writer.image("/camera/aligned_depth_to_color/image_raw", 5, bag_depth(7), "16UC1"));
  write_ros1_bag(folder_ / "three.bag", messages, "lz4");
  EXPECT_THAT(open_source(in("three.bag"))->info().notes, Contains(HasSubstr("depth from /camera/aligned")));
}

TEST_F(BagSourceTest, WithoutDepthTheErrorListsWhatThereIs) {
  write_db3(folder_ / "a.db3", {MessageWriter(true).image("/rgb", 5, bag_colour(1), "rgb8")});
  EXPECT_THAT(complaint(in("a.db3"), ExitStatus::unreadable), HasSubstr("it holds /rgb (rgb8)"));
  for (const char* name : {"a.bag", "a.mcap", "b.db3"}) {
    write_file(folder_ / name, std::string_view("something else"));
    complaint(in(name), ExitStatus::unreadable);
    write_file(folder_ / name, std::string_view(""));
    complaint(in(name), ExitStatus::unreadable);
  }
}

TEST_F(BagSourceTest, ATruncatedFileGivesWhatItHolds) {
  write_plain_mcap(folder_ / "a.mcap", recording(true));
  const auto bytes = read_file(folder_ / "a.mcap");
  write_file(folder_ / "cut.mcap", std::span(bytes).first(bytes.size() * 2 / 3));
  const auto source = open_source(in("cut.mcap"));
  EXPECT_GT(*source->info().frame_count, 1);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("truncated")));
  Frame frame;
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
}

// Pixels have no other protection.
TEST_F(BagSourceTest, AChunkWhoseChecksumDoesNotFitIsDamaged) {
  write_mcap(folder_ / "a.mcap", recording(true), "", true);
  expect_recording(in("a.mcap"));
  auto bytes = read_file(folder_ / "a.mcap");
  bytes[bytes.size() / 2] ^= 1;
  write_file(folder_ / "a.mcap", bytes);
  EXPECT_THAT(complaint(in("a.mcap"), ExitStatus::unreadable), HasSubstr("its checksum does not fit"));
}

TEST_F(BagSourceTest, ARecordThatIsLongerThanItsChunkEndsIt) {
  const auto messages = recording(true);
  write_mcap(folder_ / "a.mcap", messages, "");
  auto bytes = read_file(folder_ / "a.mcap");
  constexpr std::size_t kAfterTheChunk = (9 + 4) + (9 + 20) + 8, kFields = 22, kLength = 8;
  const std::size_t length = bytes.size() - kAfterTheChunk - messages.back().bytes.size() - kFields - kLength;
  ASSERT_EQ(bytes.at(length), (messages.back().bytes.size() + kFields) & 0xFF);
  ++bytes[length];
  write_file(folder_ / "a.mcap", bytes);
  const auto source = open_source(in("a.mcap"));
  EXPECT_EQ(source->info().frame_count, 4) << "the last message is one of colour";
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("a record is longer than its chunk")));
}

TEST_F(BagSourceTest, MessagesOfAnotherSerialisationAreNotRead) {
  write_db3(folder_ / "a.db3", recording(true), "other");
  EXPECT_THAT(complaint(in("a.db3"), ExitStatus::unreadable), HasSubstr("no topic of depth"));
}

// That it is damaged is the reason, not that it holds no topic of depth.
TEST_F(BagSourceTest, AFileOfWhichNoDepthIsLeftIsCalledDamaged) {
  write_ros1_bag(folder_ / "a.bag", recording(false), "lz4");
  fs::resize_file(folder_ / "a.bag", fs::file_size(folder_ / "a.bag") / 2);  // in its only chunk
  EXPECT_THAT(complaint(in("a.bag"), ExitStatus::unreadable),
              AllOf(HasSubstr("no depth is left in this damaged file; "), HasSubstr("truncated")));
}

// The pages of a table all lead to the first one.
TEST_F(BagSourceTest, ADatabaseWhosePagesLeadInCirclesEnds) {
  const MessageWriter writer(true);
  std::vector<TestMessage> messages;
  constexpr int kMessages = 100;
  for (int k = 0; k < kMessages; ++k)
    messages.push_back(writer.image(kDepth, kBegin_ns + 1'000'000 * k, bag_depth(k), "16UC1"));
  write_db3(folder_ / "a.db3", messages);
  auto bytes = read_file(folder_ / "a.db3");
  // The root of the table: a page of children, each with its number (4 bytes, the highest first) and a key.
  constexpr std::size_t kPage = 4096, kHeader = 12;
  const auto number = [&](std::size_t at) { return 256U * bytes[at] + bytes[at + 1]; };
  std::size_t root = kPage;
  while (root < bytes.size() && bytes[root] != 5) root += kPage;
  ASSERT_LT(root, bytes.size());
  const std::size_t children = number(root + 3);
  ASSERT_GT(children, 5U);
  const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(root + number(root + kHeader));
  for (std::size_t k = 1; k < children; ++k)
    std::copy_n(first, 4, bytes.begin() + static_cast<std::ptrdiff_t>(root + number(root + kHeader + 2 * k)));
  write_file(folder_ / "a.db3", bytes);
  const auto source = open_source(in("a.db3"));
  EXPECT_GT(*source->info().frame_count, 1);
  EXPECT_LT(*source->info().frame_count, kMessages / 5);
  EXPECT_THAT(source->info().notes, Contains(HasSubstr("its messages are not in their order")));
}

TEST_F(BagSourceTest, ADatabaseMadeSoThatItNeverEndsIsRefused) {
  write_db3(folder_ / "a.db3", recording(true));
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "a.db3").c_str(), &database), SQLITE_OK);
  EXPECT_EQ(
      sqlite3_exec(database,
                   "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL "
                   "SELECT i + 1 FROM n) SELECT i AS rowid, 1 AS topic_id, 0 AS timestamp, 0 AS data FROM n",
                   nullptr, nullptr, nullptr),
      SQLITE_OK);
  sqlite3_close(database);
  EXPECT_THAT(complaint(in("a.db3"), ExitStatus::unreadable), HasSubstr("reading it does not end"));
}

// Every byte that lies, and every length cut: an error or frames, and no access outside of the memory.
TEST_F(BagSourceTest, DamagedFilesNeverCrash) {
  write_ros1_bag(folder_ / "a.bag", recording(false), "none");
  write_mcap(folder_ / "a.mcap", recording(true), "lz4");
  write_plain_mcap(folder_ / "b.mcap", recording(true));
  write_db3(folder_ / "a.db3", recording(true));
  std::mt19937 random(7);
  for (const std::string name : {"a.bag", "a.mcap", "b.mcap", "a.db3"}) {
    const auto sound = read_file(folder_ / name);
    for (int round = 0; round < 150; ++round) {
      auto bytes = sound;
      for (int k = 0; k < 1 + round % 4; ++k)
        bytes[random() % (round % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 600))] =
            static_cast<std::uint8_t>(round % 3 == 0 ? 0xff : random());
      if (round % 5 == 0) bytes.resize(random() % bytes.size());
      write_file(folder_ / ("x_" + name), bytes);
      try {
        const auto source = open_source(in("x_" + name));
        Frame frame;
        for (int k = 0; k < 8; ++k)
          if (source->read(frame, kNoWait).status == ReadStatus::end) break;
      } catch (const Error& error) {
        EXPECT_NE(error.status(), ExitStatus::failed) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace saccade
