// Folders as data sets have them.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/png.hpp"
#include "pcd_writer.hpp"
#include "sources/open_source.hpp"
#include "tests/support/folder_test.hpp"
#include "tests/support/no_wait.hpp"

namespace saccade {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

class FolderLayouts : public FolderTest {
 protected:
  void put(const std::string& name, const cv::Mat& image) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, encode_png(image));
  }
  void put_depth(const std::string& name, int value) const {
    put(name, cv::Mat1w(12, 16, static_cast<std::uint16_t>(value)));
  }
  void put_colour(const std::string& name, int value) const {
    const cv::Mat3b image(12, 16, cv::Vec3b::all(static_cast<std::uint8_t>(value)));
    if (name.ends_with(".png")) return put(name, image);
    fs::create_directories((folder_ / name).parent_path());
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", image, jpeg);
    write_file(folder_ / name, jpeg);
  }
  void put_text(const std::string& name, std::string_view text) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, text);
  }

  std::vector<Frame> read(const std::string& kind, const std::string& name = "") const {
    const auto source = open_source((folder_ / name).string());
    EXPECT_EQ(source->info().kind, kind);
    std::vector<Frame> frames;
    for (Frame frame; source->read(frame, kNoWait).status == ReadStatus::frame;) {
      frames.emplace_back();
      copy_frame(frame, frames.back());
    }
    return frames;
  }
};

TEST_F(FolderLayouts, Open3dPairsByNumberAndNamesItsCamera) {
  put_depth("depth/0000001-000000000000.png", 1001);
  put_depth("depth/0000003-000066000000.PNG", 1003);
  put_colour("image/0000001-000000010000.jpg", 11);
  put_colour("image/0000003-000066010000.JPG", 13);
  put_text("camera_intrinsic.json",
           R"({"width":16,"height":12,"intrinsic_matrix":[500,0,0,0,501,0,7.5,5.5,1]})");
  const auto frames = read("paired");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].depth_mm(0, 0), 1003);
  EXPECT_NEAR(frames[1].colour(5, 5)[0], 13, 2);
  EXPECT_EQ(frames[0].intrinsics.fy, 501);
  EXPECT_EQ(frames[0].intrinsics.cx, 7.5);
  EXPECT_EQ(frames[1].timestamp_us, 66667) << "two thirtieths of a second after number 1";
  EXPECT_THAT(open_source(folder_.string())->info().notes, Contains(HasSubstr("1 frame is missing")));
}

TEST_F(FolderLayouts, ScanNetHasPosesAndColourOfAnotherSize) {
  for (const int i : {0, 1, 10}) {
    put_depth("depth/" + std::to_string(i) + ".png", 1000 + i);
    put("color/" + std::to_string(i) + ".png",
        cv::Mat3b(24, 32, cv::Vec3b::all(static_cast<std::uint8_t>(i))));
    put_text("pose/" + std::to_string(i) + ".txt",
             i == 1 ? "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
                    : "1 0 0 0.5\n0 1 0 0\n0 0 1 2\n0 0 0 1\n");
  }
  put_text("intrinsic/intrinsic_depth.txt", "577.5 0 319.5 0\n0 578.5 239.5 0\n0 0 1 0\n0 0 0 1\n");
  const auto frames = read("paired");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[2].depth_mm(0, 0), 1010) << "in the order of the numbers";
  EXPECT_EQ(frames[2].colour.size(), cv::Size(16, 12));
  EXPECT_EQ(frames[2].colour(3, 3)[0], 10);
  EXPECT_EQ(frames[0].intrinsics.fx, 577.5);
  ASSERT_TRUE(frames[0].truth.camera_to_world);
  EXPECT_EQ(frames[0].truth.camera_to_world->translation(), cv::Vec3d(500, 0, 2000));
  EXPECT_FALSE(frames[1].truth.camera_to_world) << "the camera was lost";
  EXPECT_TRUE(open_source(folder_.string())->info().sequence);
  put_text("pose/0.txt", "no numbers");
  EXPECT_FALSE(read("paired")[0].truth.camera_to_world);
  EXPECT_THAT(open_source(folder_.string())->info().notes,
              Contains(HasSubstr("1 of 3 poses cannot be used; the first: not only numbers: ")));
}

TEST_F(FolderLayouts, ATrajectoryOfOpen3dGivesPosesByPosition) {
  for (const int i : {0, 1, 2}) {
    put_depth("depth/0000" + std::to_string(i + 1) + ".png", 1000 + i);
    put_colour("color/0000" + std::to_string(i + 1) + ".jpg", 10);
  }
  put_text("trajectory.log",
           "0 0 1\n1 0 0 0.5\n0 1 0 0\n0 0 1 2\n0 0 0 1\n2 2 3\n1 0 0 -1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
           "7 7 8\n1 0 0 -1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const auto frames = read("paired");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].truth.camera_to_world->translation(), cv::Vec3d(500, 0, 2000));
  EXPECT_FALSE(frames[1].truth.camera_to_world);
  EXPECT_EQ(frames[2].truth.camera_to_world->translation(), cv::Vec3d(-1000, 0, 0));
  put_text("trajectory.log", "0 0 1\n1 0 0 0.5\n");
  EXPECT_THROW(open_source(folder_.string()), Error);
}

TEST_F(FolderLayouts, OcidHasLabels) {
  put_depth("depth/result_a.png", 1000);
  put_colour("rgb/result_a.png", 5);
  put("label/result_a.png", cv::Mat1w(12, 16, std::uint16_t{3}));
  const auto frames = read("paired");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].truth.labels(4, 4), 3);
}

TEST_F(FolderLayouts, SunRgbdIsRotatedBack) {
  const int mm = 2345;
  put_depth("depth/0001.png", (mm << 3 | mm >> 13) & 0xffff);
  put_colour("image/NYU0001.jpg", 9);
  put_text("intrinsics.txt", "518.857901 0.000000 284.582449\n0.000000 519.469611 208.736166\n0 0 1\n");
  put_text("scene.txt", "bedroom");
  const auto frames = read("paired");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].depth_mm(4, 4), 2345);
  EXPECT_FALSE(frames[0].colour.empty()) << "the only colour belongs to the only depth";
  EXPECT_EQ(frames[0].intrinsics.cx, 284.582449);
}

TEST_F(FolderLayouts, BopHasCamerasUnitsAndMasks) {
  put_depth("depth/000003.png", 10000);
  put_depth("depth/000007.png", 20000);
  put_colour("rgb/000003.png", 3);
  put("mask_visib/000003_000000.png", cv::Mat1b(12, 16, std::uint8_t{255}));
  cv::Mat1b second(12, 16, std::uint8_t{0});
  second(4, 4) = 255;
  put("mask_visib/000003_000001.png", second);
  put_text("scene_camera.json", R"({
    "3": {"cam_K": [600, 0, 8, 0, 601, 6, 0, 0, 1], "depth_scale": 0.1,
          "cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_w2c": [0, 0, 500]},
    "7": {"cam_K": [700, 0, 8, 0, 701, 6, 0, 0, 1], "depth_scale": 0.1}})");
  const auto frames = read("bop");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].depth_mm(4, 4), 1000);
  EXPECT_EQ(frames[0].intrinsics.fx, 600);
  EXPECT_EQ(frames[1].intrinsics.fx, 700) << "each frame has its own";
  EXPECT_EQ(frames[0].truth.labels(0, 0), 1);
  EXPECT_EQ(frames[0].truth.labels(4, 4), 2);
  EXPECT_NEAR(cv::norm(frames[0].truth.camera_to_world->translation() - cv::Vec3d(0, 0, -500)), 0, 1e-9);
  for (const char* broken : {"[]", "{}", R"({"3": {"cam_K": [1, 2]}})", R"({"3": {}})"}) {
    put_text("scene_camera.json", broken);
    EXPECT_THROW(open_source(folder_.string()), Error) << broken;
  }
}

TEST_F(FolderLayouts, SevenScenesAndYcb) {
  put_depth("seven/frame-000000.depth.png", 65535);
  put_depth("seven/frame-000002.depth.png", 1500);
  put_colour("seven/frame-000002.color.png", 4);
  put_text("seven/frame-000002.pose.txt", "1 0 0 1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const auto seven = read("suffix", "seven");
  ASSERT_EQ(seven.size(), 2U);
  EXPECT_EQ(seven[0].depth_mm(1, 1), 0);
  EXPECT_EQ(seven[1].depth_mm(1, 1), 1500);
  EXPECT_EQ(seven[1].intrinsics.fx, 585);
  EXPECT_EQ(seven[1].truth.camera_to_world->translation()[0], 1000);
  put_text("seven/frame-000000.pose.txt", "1 0 0 1\n0 1 0");  // cut
  const auto cut = read("suffix", "seven");
  ASSERT_EQ(cut.size(), 2U) << "depth does not need its pose";
  EXPECT_FALSE(cut[0].truth.camera_to_world);
  EXPECT_TRUE(cut[1].truth.camera_to_world);
  EXPECT_THAT(open_source((folder_ / "seven").string())->info().notes,
              Contains(HasSubstr("1 of 2 poses cannot be used; the first: not a 4 x 4 matrix: ")));
  put_depth("ycb/000001-depth.png", 12345);
  put_colour("ycb/000001-color.png", 4);
  put("ycb/000001-label.png", cv::Mat1b(12, 16, std::uint8_t{5}));
  const auto ycb = read("suffix", "ycb");
  ASSERT_EQ(ycb.size(), 1U);
  EXPECT_EQ(ycb[0].depth_mm(1, 1), 1234.5F);
  EXPECT_EQ(ycb[0].truth.labels(1, 1), 5);
}

TEST_F(FolderLayouts, ASinglePngBringsItsColour) {
  put_depth("a/table_depth.png", 1200);
  put_colour("a/table_color.jpg", 40);
  const auto frames = read("images", "a/table_depth.png");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].depth_mm(1, 1), 1200);
  EXPECT_NEAR(frames[0].colour(1, 1)[0], 40, 2);
}

// The colour of an image beside a cloud, else that of its points. A depth image beside it is no colour.
TEST_F(FolderLayouts, CloudsBringTheirColour) {
  const Intrinsics camera{20, 20, 7.5, 5.5, IntrinsicsOrigin::file};
  const cv::Mat1f depth(12, 16, 1500.0F);
  const cv::Mat3b own(12, 16, cv::Vec3b(1, 2, 3));
  const auto put_cloud = [&](const std::string& name, const cv::Mat3b& colour) {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, write_pcd(depth, camera, PcdEncoding::binary, colour));
  };
  put_cloud("a/table_1.pcd", own);
  put_cloud("a/table_2.pcd", own);
  put_cloud("a/table_3.pcd", {});
  put_colour("a/table_2.png", 40);
  put_depth("a/table_3.png", 1500);
  const auto frames = read("clouds", "a");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(cv::norm(frames[0].colour, own, cv::NORM_INF), 0);
  EXPECT_EQ(frames[1].colour(1, 1), cv::Vec3b::all(40));
  EXPECT_TRUE(frames[2].colour.empty());
  EXPECT_EQ(read("clouds", "a/table_2.pcd")[0].colour(1, 1), cv::Vec3b::all(40));
}

}  // namespace
}  // namespace saccade
