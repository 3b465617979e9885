#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "folder_source_fixture.hpp"
#include "tests/support/places.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(FolderSourceTest, ReadsFramesInTheOrderOfTheirNumbersWithColourAndLabels) {
  put_depth("10_depth.png", 1010);
  put_depth("9_depth.png", 65535);
  put("9_rgb.png", cv::Mat3b(12, 16, cv::Vec3b(1, 2, 3)));
  put("9_label.png", cv::Mat1b(12, 16, std::uint8_t{7}));
  put("9_class.png", cv::Mat1w(12, 16, std::uint16_t{300}));
  put_text("notes.txt", "not a frame");
  const auto source = open_source(folder_.string());
  EXPECT_EQ(source->info().frame_count, 2);
  EXPECT_EQ(source->info().size, cv::Size(16, 12));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 0);
  EXPECT_EQ(frame.name, "9");
  EXPECT_EQ(frame.timestamp_us, 0);
  EXPECT_EQ(frame.depth_mm(3, 4), 0.0F) << "65535 is no reading";
  EXPECT_EQ(frame.colour(3, 4), cv::Vec3b(1, 2, 3)) << "BGR";
  EXPECT_EQ(frame.truth.labels(3, 4), 7);
  EXPECT_EQ(frame.truth.classes(3, 4), 300) << "16 bits";
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 1);
  EXPECT_EQ(frame.timestamp_us, 33333);
  EXPECT_EQ(frame.depth_mm(0, 0), 1010.0F);
  EXPECT_TRUE(frame.colour.empty()) << "nothing of the frame before";
  EXPECT_TRUE(frame.truth.labels.empty());
  EXPECT_TRUE(frame.truth.classes.empty());
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
  source->seek(1);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.name, "10");
}

// The first frame is looked at when a source is opened. It is not read again, unless somebody goes back to
// it.
TEST_F(FolderSourceTest, TheFirstFrameIsReadOnce) {
  for (const int i : {0, 1, 2, 3}) put_depth(std::to_string(i) + "_depth.png", 1000 + i);
  put_text("0_depth.png", "no image");
  const auto source = open_source(folder_.string());
  fs::remove(folder_ / "0_depth.png");
  fs::remove(folder_ / "1_depth.png");
  Frame frame;
  source->seek(0);
  const ReadResult broken = source->read(frame, kNoWait);
  EXPECT_EQ(broken.status, ReadStatus::rejected);
  EXPECT_THAT(broken.reason, HasSubstr("not a valid PNG"));
  for (const int i : {1, 2}) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame) << i;
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(frame.depth_mm(0, 0), static_cast<float>(1000 + i));
  }
  source->seek(1);
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::rejected) << "it is gone";
  source->seek(3);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 3);
}

TEST_F(FolderSourceTest, ASeekSkipsWhatWasReadAhead) {
  for (const int i : {0, 1, 2}) put_depth(std::to_string(i) + "_depth.png", 1000 + i);
  const auto source = open_source(folder_.string());
  Frame frame;
  source->seek(2);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.index, 2);
  source->seek(0);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(0, 0), 1000);
}

TEST_F(FolderSourceTest, PosesMakeASequence) {
  for (const char* name : {"0_depth.png", "1_depth.png", "2_depth.png"}) put_depth(name, 1000);
  EXPECT_FALSE(open_source(folder_.string())->info().sequence);
  put_text("poses.txt", "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n\n1 0 0 0.5 0 1 0 -0.25 0 0 1 2 0 0 0 1\n");
  const auto source = open_source(folder_.string());
  EXPECT_TRUE(source->info().sequence);
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  ASSERT_TRUE(frame.truth.camera_to_world);
  EXPECT_EQ(frame.truth.camera_to_world->translation(), cv::Vec3d(500, -250, 2000)) << "in mm";
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_FALSE(frame.truth.camera_to_world) << "there is no third pose";
  put_text("poses.txt", "nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan nan\n");
  ASSERT_EQ(open_source(folder_.string())->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_FALSE(frame.truth.camera_to_world) << "the camera was lost";
  put_text("poses.txt", "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0\n");
  EXPECT_THAT(error(), HasSubstr("pose 0 is not 16 numbers"));
}

TEST_F(FolderSourceTest, GapsInTheNumbersAreReported) {
  for (const char* name : {"0001_depth.png", "0003_depth.png", "0007_depth.png"}) put_depth(name, 1000);
  EXPECT_THAT(open_source(folder_.string())->info().notes,
              ElementsAre("4 frames are missing in the numbering: 2, 4..6"));
}

TEST_F(FolderSourceTest, JpegColourIsRead) {
  put_depth("0_depth.png", 1000);
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", cv::Mat3b(12, 16, cv::Vec3b(200, 200, 200)), jpeg);
  write_file(folder_ / "0_rgb.jpg", jpeg);
  Frame frame;
  ASSERT_EQ(open_source(folder_.string())->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_NEAR(frame.colour(5, 5)[0], 200, 3);
}

TEST_F(FolderSourceTest, MetaGivesTheCameraAndItsAbsenceIsAGuess) {
  put_depth("0_depth.png", 1000);
  EXPECT_EQ(open_source(folder_.string())->info().intrinsics.origin, IntrinsicsOrigin::guess);
  put_text("meta.json", R"({"name": "x"})");
  EXPECT_EQ(open_source(folder_.string())->info().intrinsics.origin, IntrinsicsOrigin::guess);
  put_text("meta.json", R"({"fx": 500, "fy": 501.5, "cx": 8, "cy": 6})");
  const Intrinsics camera = open_source(folder_.string())->info().intrinsics;
  EXPECT_EQ(camera.origin, IntrinsicsOrigin::file);
  EXPECT_EQ(camera.fy, 501.5);
}

TEST_F(FolderSourceTest, TheUnitOfDepthIsThatOfTheUserElseOfMetaElseMillimetres) {
  put_depth("0_depth.png", 12345);
  const auto depth_of = [&](double given) {
    const auto source = open_source(folder_.string(), {{}, {.depth_unit_mm = given}});
    Frame frame;
    EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    return frame.depth_mm(3, 4);
  };
  EXPECT_EQ(depth_of(0), 12345.0F);
  put_text("meta.json", R"({"depth_unit_mm": 0.1})");
  EXPECT_EQ(depth_of(0), 1234.5F);
  EXPECT_EQ(depth_of(0.25), 12345 * 0.25F);
  // As Open3D, RealSense and BOP write it.
  for (const auto& [scale, unit] : {std::pair{"5000", 0.2}, std::pair{"0.001", 1.0}, std::pair{"0.1", 0.1}}) {
    put_text("meta.json", std::string(R"({"depth_scale": )") + scale + "}");
    EXPECT_EQ(depth_of(0), static_cast<float>(12345 * unit)) << scale;
    EXPECT_THAT(open_source(folder_.string())->info().notes, Contains(HasSubstr("one unit is"))) << scale;
  }
}

TEST_F(FolderSourceTest, DepthInAWrongUnitIsReported) {
  put_depth("0_depth.png", 20000);  // 2 m in tenths of a millimetre
  EXPECT_THAT(open_source(folder_.string())->info().notes,
              ElementsAre("depth is implausible, its median is 20 m; its unit is likely 0.1 mm: try "
                          "--depth-unit 0.1"));
  EXPECT_THAT(open_source(folder_.string(), {{}, {.depth_unit_mm = 0.1}})->info().notes, IsEmpty());
  put_depth("0_depth.png", 30);
  EXPECT_THAT(open_source(folder_.string())->info().notes, ElementsAre(HasSubstr("its median is 30 mm")));
  put_depth("0_depth.png", 4000);
  EXPECT_THAT(open_source(folder_.string())->info().notes, IsEmpty());
  EXPECT_THAT(open_source(folder_.string(), {{}, {.depth_unit_mm = 100}})->info().notes,
              ElementsAre(HasSubstr("nothing beyond 65.5 m can be used")));
}

// Times whose difference would overflow, and a rate whose period would.
TEST_F(FolderSourceTest, ImpossibleTimesAreRefused) {
  for (const int i : {0, 1}) put_depth(std::to_string(i) + "_depth.png", 1000 + i);
  for (const char* time : {"-9223372036854775808", "9223372036854775807", "1000000000000001"}) {
    put_text("times.txt", std::string("0 0\n1 ") + time + "\n");
    EXPECT_THROW(open_source(folder_.string()), Error) << time;
  }
  put_text("times.txt", "0 -1000000000000000\n1 1000000000000000\n");
  EXPECT_NO_THROW(open_source(folder_.string()));
  for (const char* rate : {"1e-300", "0.0009", "0", "-1", "1e7"}) {
    put_text("meta.json", std::string(R"({"rate_hz": )") + rate + "}");
    EXPECT_THROW(open_source(folder_.string()), Error) << rate;
  }
  put_text("meta.json", R"({"rate_hz": 0.001})");
  EXPECT_EQ(open_source(folder_.string())->info().rate_hz, 0.001);
}

TEST_F(FolderSourceTest, TimesAreThoseOfTheList) {
  for (const int i : {0, 1, 3}) put_depth(std::to_string(i) + "_depth.png", 1000 + i);
  put_text("times.txt", "# frame microseconds\n0 -5\n3 900000\n1 70\n");
  const auto source = open_source(folder_.string());
  EXPECT_TRUE(source->info().sequence);
  std::vector<std::int64_t> times;
  for (Frame frame; source->read(frame, kNoWait).status == ReadStatus::frame;)
    times.push_back(frame.timestamp_us);
  EXPECT_THAT(times, ElementsAre(-5, 70, 900000));
  put_text("times.txt", "0 1\n1 x\n");
  EXPECT_THAT(error(), HasSubstr("times.txt:2"));
}

TEST_F(FolderSourceTest, BrokenMetaIsAnError) {
  put_depth("0_depth.png", 1000);
  for (const char* text :
       {"{", "[1]", "", R"({"fx": 1})", R"({"fx": "a", "fy": 1, "cx": 1, "cy": 1})",
        R"({"fx": -5, "fy": 1, "cx": 1, "cy": 1})", R"({"fx": 1e999, "fy": 1, "cx": 1, "cy": 1})"}) {
    put_text("meta.json", text);
    EXPECT_THAT(error(), HasSubstr("meta.json")) << text;
  }
}

TEST_F(FolderSourceTest, WrongDepthImagesAreNamedWithTheReason) {
  const auto put_only = [&](const cv::Mat& image) { put("0000_depth.png", image); };
  put_only(cv::Mat1b(12, 16, std::uint8_t{1}));
  EXPECT_THAT(error(), HasSubstr("0000_depth.png: 8-bit grey is not 16-bit grey depth"));
  put_only(cv::Mat3b(12, 16, cv::Vec3b()));
  EXPECT_THAT(error(), HasSubstr("8-bit RGB is not 16-bit grey depth"));
  put_only(cv::Mat1w(1, 1, std::uint16_t{1}));
  EXPECT_THAT(error(), HasSubstr("1x1 is smaller than 8 pixels"));
  put_only(cv::Mat1w(8, 8193, std::uint16_t{1}));
  EXPECT_THAT(error(), HasSubstr("8193x8 is larger than 8192 pixels"));
  put_text("0000_depth.png", "");
  EXPECT_THAT(error(), HasSubstr("empty file"));
  std::vector<std::uint8_t> tiff;
  cv::imencode(".tiff", cv::Mat1f(12, 16, 1.0F), tiff);
  write_file(folder_ / "0000_depth.png", tiff);
  EXPECT_THAT(error(), HasSubstr("not a valid PNG"));
}

TEST_F(FolderSourceTest, AFrameCutShortIsRejectedAndTheNextIsRead) {
  put_depth("0_depth.png", 1000);
  put_depth("1_depth.png", 1000);
  put_depth("2_depth.png", 1002);
  auto bytes = read_file(folder_ / "1_depth.png");
  bytes.resize(bytes.size() - 30);
  write_file(folder_ / "1_depth.png", bytes);
  const auto source = open_source(folder_.string());
  Frame frame;
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  const ReadResult result = source->read(frame, kNoWait);
  EXPECT_EQ(result.status, ReadStatus::rejected);
  EXPECT_EQ(frame.index, 1);
  EXPECT_THAT(result.reason, HasSubstr("1_depth.png"));
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(0, 0), 1002.0F);
}

TEST_F(FolderSourceTest, CompanionsThatCannotBeUsedDoNotCostTheDepth) {
  put_depth("0_depth.png", 1000);
  put_depth("1_depth.png", 1000, {32, 24});
  EXPECT_THAT(rejection(), HasSubstr("32x24, but the first frame is 16x12"));
  put_depth("1_depth.png", 1000);
  put("1_rgb.png", cv::Mat3b(24, 32, cv::Vec3b(9, 8, 7)));
  EXPECT_EQ(lack(), "") << "it is scaled";
  EXPECT_THAT(open_source(folder_.string())->info().notes,
              ElementsAre("colour of 32 x 24 is scaled to the depth's 16 x 12"));
  put_text("1_rgb.png", "not a picture");
  EXPECT_THAT(lack(), HasSubstr("no colour: 1_rgb.png: "));
  fs::remove(folder_ / "1_rgb.png");
  put("1_label.png", cv::Mat1b(24, 32, std::uint8_t{1}));
  EXPECT_THAT(lack(), HasSubstr("1_label.png"));
  put("1_label.png", cv::Mat3b(12, 16, cv::Vec3b()));
  EXPECT_THAT(lack(), HasSubstr("labels must be grey or palette"));
  put("1_label.png", cv::Mat1b(12, 16, std::uint8_t{1}));
  put("1_class.png", cv::Mat3b(12, 16));
  EXPECT_THAT(lack(), HasSubstr("1_class.png: labels must be grey or palette"));
  put("1_class.png", cv::Mat1b(12, 15));
  EXPECT_THAT(lack(), HasSubstr("1_class.png: 15x12, but the depth is 16x12"));
}

TEST_F(FolderSourceTest, AJpegThatIsCutOrLiesAboutItsSizeIsNoColour) {
  put_depth("0_depth.png", 1000);
  put_depth("1_depth.png", 1000);
  cv::Mat3b image(12, 16);
  cv::randu(image, 0, 255);
  std::vector<std::uint8_t> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", image, jpeg));
  const std::span<const std::uint8_t> all(jpeg);
  for (const std::size_t bytes : {all.size() - 2, all.size() * 3 / 4, std::size_t{200}, std::size_t{3}}) {
    write_file(folder_ / "1_rgb.jpg", all.first(bytes));
    EXPECT_THAT(lack(), HasSubstr("1_rgb.jpg: ")) << bytes;
  }
  const std::array<std::uint8_t, 2> frame_header = {0xff, 0xc0};
  const auto at = std::ranges::search(jpeg, frame_header).begin() - jpeg.begin();
  for (const auto i : {5, 7}) {
    jpeg[static_cast<std::size_t>(at + i)] = 0xff;
    jpeg[static_cast<std::size_t>(at + i + 1)] = 0xdc;
  }
  write_file(folder_ / "1_rgb.jpg", jpeg);
  EXPECT_THAT(lack(), HasSubstr("1_rgb.jpg: 65500x65500 is larger than 8192"));
}

// A PNG of any size that holds nothing.
std::vector<std::uint8_t> empty_png(std::uint32_t width, std::uint32_t height, std::uint8_t bits) {
  std::vector<std::uint8_t> png = encode_png(cv::Mat1w(8, 8, std::uint16_t{0}));
  const auto put_side = [&](std::size_t at, std::uint32_t side) {
    for (std::size_t i = 0; i < 4; ++i) png[at + i] = static_cast<std::uint8_t>(side >> (24 - 8 * i));
  };
  put_side(16, width);
  put_side(20, height);
  png[24] = bits;
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= png[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
  }
  put_side(29, ~crc);
  return png;
}

TEST_F(FolderSourceTest, ImagesOfTooManyPixelsAreNotDecoded) {
  write_file(folder_ / "0_depth.png", empty_png(8192, 1954, 16));
  EXPECT_THAT(error(), HasSubstr("0_depth.png: 8192x1954 has more than 16 megapixels"));
  put_depth("0_depth.png", 1000);
  put_depth("1_depth.png", 1000);
  for (const char* name : {"1_rgb.png", "1_label.png", "1_class.png"}) {
    write_file(folder_ / name, empty_png(30000, 30000, 8));
    EXPECT_THAT(lack(), HasSubstr(std::string(name) + ": 30000x30000 is larger than 8192"));
    fs::remove(folder_ / name);
  }
}

TEST_F(FolderSourceTest, NumbersCanBeAsLargeAsIntegers) {
  put_depth("0_depth.png", 1000);
  put_depth("9223372036854775807_depth.png", 1001);
  put_depth("9223372036854775808_depth.png", 1002);  // no longer a number
  const auto source = open_source(folder_.string());
  EXPECT_EQ(source->info().frame_count, 2);
  EXPECT_THAT(source->info().notes, ElementsAre(HasSubstr("9223372036854775806 frames are missing")));
  Frame frame;
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_GT(frame.timestamp_us, 0);
}

TEST_F(FolderSourceTest, OneNumberIsOneFrame) {
  put_depth("1_depth.png", 1000);
  put_depth("-2_depth.png", 1001);  // not a number of a frame
  EXPECT_EQ(open_source(folder_.string())->info().frame_count, 1);
  put_depth("0001_depth.png", 1002);
  EXPECT_THAT(error(), HasSubstr("two depth images have the same number"));
}

TEST_F(FolderSourceTest, AHugeMetaFileIsRefusedBeforeItIsRead) {
  put_depth("0_depth.png", 1000);
  put_text("meta.json", std::string(2 << 20, '['));
  EXPECT_THAT(error(), HasSubstr("meta.json"));
}

TEST_F(FolderSourceTest, EmptyAndMissingFoldersAreErrors) {
  EXPECT_THAT(error(), HasSubstr("no frames in the folder"));
  EXPECT_THROW(open_source((folder_ / "none").string()), Error);
}

TEST(FolderSourceOnRealData, ReadsEveryFrame) {
  for (const char* name : {"osd_learn", "kitchen_sequence"}) {
    const fs::path folder = in_shared(std::string("data/") + name);
    if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not on this machine";
    const auto source = open_source(folder.string());
    EXPECT_THAT(source->info().notes, IsEmpty());
    EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::file);
    Frame frame;
    std::int64_t count = 0;
    ReadResult result;
    while ((result = source->read(frame, kNoWait)).status == ReadStatus::frame) {
      ++count;
      EXPECT_FALSE(frame.colour.empty());
    }
    EXPECT_EQ(result.status, ReadStatus::end) << result.reason;
    EXPECT_EQ(count, source->info().frame_count);
  }
}

}  // namespace
}  // namespace saccade
