// Folders as the TUM RGB-D benchmark has them: lists of times and files.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "folder_source_fixture.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TumFolderTest : public FolderSourceTest {};

TEST_F(TumFolderTest, TumFolderIsPairedByTime) {
  fs::create_directories(folder_ / "depth");
  fs::create_directories(folder_ / "rgb");
  put_depth("depth/a.png", 5000);
  put_depth("depth/b.png", 2501);
  put("rgb/a.png", cv::Mat3b(12, 16, cv::Vec3b(9, 9, 9)));
  put_text("depth.txt", "# depth maps\n# timestamp filename\n100.50 depth/b.png\n100.25 depth/a.png\n");
  put_text("rgb.txt", "# colour\n100.26 rgb/a.png\n100.60 rgb/a.png\n");
  const auto source = open_source(folder_.string());
  EXPECT_EQ(source->info().kind, "tum");
  EXPECT_THAT(source->info().notes, ElementsAre("1 depth frame without a colour image within 20 ms"));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(0, 0), 1000.0F);
  EXPECT_EQ(frame.colour(0, 0)[0], 9);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.timestamp_us, 250000);
  EXPECT_FLOAT_EQ(frame.depth_mm(0, 0), 500.2F);
  EXPECT_TRUE(frame.colour.empty());
}

// Of images as near in time as each other, the one before; of images of one time, the first of the list.
TEST_F(TumFolderTest, TiesInATumFolderHaveOneOutcome) {
  put_depth("a.png", 5000);
  for (const int k : {1, 2, 3, 4})
    put(fmt::format("{}.png", k), cv::Mat3b(12, 16, cv::Vec3b::all(static_cast<std::uint8_t>(k))));
  put_text("depth.txt", "10.5 a.png\n20.5 a.png\n");
  put_text("rgb.txt", "10.4921875 1.png\n10.5078125 2.png\n20.4921875 3.png\n20.4921875 4.png\n");
  const auto source = open_source(folder_.string());
  Frame frame;
  for (const int k : {1, 3}) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_EQ(frame.colour(0, 0)[0], k);
  }
}

TEST_F(TumFolderTest, BrokenTumListNamesTheLine) {
  put_text("depth.txt", "1.0 a.png\nnonsense b.png\n");
  EXPECT_THAT(error(), HasSubstr("depth.txt:2"));
  put_text("depth.txt", "# nothing\n");
  EXPECT_THAT(error(), HasSubstr("no frames in the list"));
}

// Camera to world, metres; between two poses, a share of the way and of the turn.
TEST_F(TumFolderTest, PosesAreThoseOfTheirTimes) {
  put_depth("a.png", 5000);
  put_text("depth.txt", "1.00 a.png\n1.05 a.png\n1.09 a.png\n1.30 a.png\n2.00 a.png\n");
  put_text(
      "groundtruth.txt",
      "# timestamp tx ty tz qx qy qz qw\n1.00 0 0 0 0 0 0 1\n1.10 1 2 -3 0 0 0.70710678118 0.70710678118\n"
      "1.40 9 9 9 0 0 0 2\n2.0 5 5 5 0 0 0 -1\n");
  const auto source = open_source(folder_.string());
  EXPECT_THAT(source->info().notes, Contains("1 depth frame without a pose in groundtruth.txt"));
  std::vector<std::optional<cv::Affine3d>> poses;
  for (Frame frame; source->read(frame, kNoWait).status == ReadStatus::frame;)
    poses.push_back(frame.truth.camera_to_world);
  ASSERT_EQ(poses.size(), 5U);
  EXPECT_EQ(poses[0]->translation(), cv::Vec3d(0, 0, 0));
  EXPECT_LT(cv::norm(poses[1]->translation() - cv::Vec3d(500, 1000, -1500)), 1e-6);
  EXPECT_NEAR(cv::norm(poses[1]->rvec()), CV_PI / 4, 1e-9);
  EXPECT_NEAR(cv::norm(poses[2]->rvec()), 0.9 * CV_PI / 2, 1e-9);
  EXPECT_FALSE(poses[3]) << "0.3 s apart";
  EXPECT_EQ(poses[4]->translation(), cv::Vec3d(5000, 5000, 5000));
  put_text("groundtruth.txt", "1.0 0 0 0 0 0 0 1\n1.1 0 0 0 0\n");
  EXPECT_THAT(error(), HasSubstr("groundtruth.txt:2"));
}

TEST_F(TumFolderTest, TumListsCannotLeadOutOfTheFolder) {
  for (const char* name : {"/etc/hostname", "../a.png", "depth/../../a.png"}) {
    put_text("depth.txt", std::string("1.0 ") + name + "\n");
    EXPECT_THAT(error(), HasSubstr("a file outside of the folder")) << name;
  }
}

// Such a line is damaged, and no name of a file.
TEST_F(TumFolderTest, NamesWithControlCharactersAreRefused) {
  put_text("depth.txt", std::string_view("1.0 depth\0.png\n", 15));
  EXPECT_THAT(error(), HasSubstr("not a 'timestamp filename' line"));
  put_text("depth.txt", "1.0 d\xe9p.png\n");  // as in file systems of before UTF-8
  put_depth("d\xe9p.png", 5000);
  EXPECT_EQ(open_source(folder_.string())->info().frame_count, 1);
}

TEST_F(TumFolderTest, LongTumListsArePairedInALittleTime) {
  std::string depth, colour;
  for (int k = 0; k < 100'000; ++k) {
    depth += fmt::format("{}.5 {}.png\n", k, k);
    colour += fmt::format("{}.51 c{}.png\n{}.49 c{}.png\n", k, k, k, k);
  }
  put_text("depth.txt", depth);
  put_text("rgb.txt", colour);
  put_depth("0.png", 5000);
  const double begin = processor_seconds();
  const auto source = open_source(folder_.string());
  EXPECT_LT(processor_seconds() - begin, 20) << "comparing each with each takes 40";
  EXPECT_THAT(source->info().notes, IsEmpty());
}

}  // namespace
}  // namespace saccade
