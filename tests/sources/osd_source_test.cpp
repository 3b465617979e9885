// Folders in the layout of the Object Segmentation Database.

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Intrinsics kOsdCamera{40, 41, 12, 9, IntrinsicsOrigin::file};

class OsdSourceTest : public FolderTest {
 protected:
  void put(const std::string& name, const cv::Mat& image) const { put_bytes(name, encode_png(image)); }
  void put_bytes(const std::string& name, const std::vector<std::uint8_t>& bytes) const {
    fs::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, bytes);
  }
  void put_depth(const std::string& name, int value) const {
    put(name, cv::Mat1w(20, 24, static_cast<std::uint16_t>(value)));
  }
  void put_labels(const std::string& name, int value, cv::Size size = {24, 20}) const {
    put("annotation/" + name, cv::Mat1b(size, static_cast<std::uint8_t>(value)));
  }
  std::unique_ptr<FrameSource> open() const { return open_source(folder_.string()); }
};

TEST_F(OsdSourceTest, FilesBelongTogetherByTheirStems) {
  for (const char* stem : {"learn10", "test0", "learn2"})
    put_depth("disparity/" + std::string(stem) + ".png", 900);
  put("image_color/learn2.png", cv::Mat3b(20, 24, cv::Vec3b(1, 2, 3)));
  put("image_color/learn10.png", cv::Mat3b(20, 24, cv::Vec3b(4, 5, 6)));
  put_labels("learn2.png", 2);
  put_labels("learn10.png", 10);
  const auto source = open();
  EXPECT_EQ(source->info().kind, "osd");
  EXPECT_EQ(source->info().frame_count, 3);
  EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::guess);
  EXPECT_THAT(source->info().notes, ElementsAre(HasSubstr("1 of 3 frames without a file")));
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.name, "learn2");
  EXPECT_EQ(frame.depth_mm(3, 4), 900.0F);
  EXPECT_EQ(frame.colour(3, 4), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(frame.truth.labels(3, 4), 2);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.name, "learn10");
  EXPECT_EQ(frame.truth.labels(3, 4), 10);
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.name, "test0");
  EXPECT_TRUE(frame.colour.empty());
  EXPECT_TRUE(frame.truth.labels.empty());
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
}

TEST_F(OsdSourceTest, CloudsGiveDepthAndCamera) {
  cv::Mat1f depth(20, 24, 1500.0F);
  depth(5, 6) = 0;
  for (const auto encoding : {PcdEncoding::ascii, PcdEncoding::binary, PcdEncoding::compressed})
    put_bytes("point_cloud/" + to_string(encoding) + ".pcd", write_pcd(depth, kOsdCamera, encoding));
  put_labels("ascii.png", 1);
  const auto source = open();
  EXPECT_EQ(source->info().size, cv::Size(24, 20));
  EXPECT_NEAR(source->info().intrinsics.fx, 40, 0.01);
  EXPECT_EQ(source->info().intrinsics.origin, IntrinsicsOrigin::file);
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
    EXPECT_NEAR(frame.depth_mm(1, 1), 1500, 0.01);
    EXPECT_EQ(frame.depth_mm(5, 6), 0);
    EXPECT_NEAR(frame.intrinsics.cy, 9, 0.01);
  }
}

TEST_F(OsdSourceTest, DepthImagesComeBeforeClouds) {
  put_bytes("point_cloud/a.pcd", write_pcd(cv::Mat1f(20, 24, 1500.0F), kOsdCamera, PcdEncoding::binary));
  put_bytes("point_cloud/b.pcd", write_pcd(cv::Mat1f(20, 24, 1700.0F), kOsdCamera, PcdEncoding::binary));
  put_depth("depth/a.png", 800);
  put_depth("disparity/a.png", 700);
  put_labels("a.png", 1);
  write_file(folder_ / "meta.json", std::string_view(R"({"fx":500,"fy":500,"cx":10,"cy":11})"));
  const auto source = open();
  EXPECT_EQ(source->info().intrinsics.fx, 500) << "meta.json comes before the clouds";
  Frame frame;
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.depth_mm(0, 0), 800);
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_NEAR(frame.depth_mm(0, 0), 1700, 0.01);
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::end);
}

TEST_F(OsdSourceTest, ColoursOfAnAnnotationAreObjects) {
  put_depth("depth/a.png", 800);
  cv::Mat3b labels(20, 24, cv::Vec3b(0, 0, 0));
  labels(cv::Rect(0, 0, 4, 4)).setTo(cv::Vec3b(255, 0, 0));
  labels(cv::Rect(8, 0, 4, 4)).setTo(cv::Vec3b(0, 0, 255));
  labels(cv::Rect(16, 0, 4, 4)).setTo(cv::Vec3b(255, 0, 0));
  put("annotation/a.png", labels);
  const auto source = open();
  Frame frame;
  ASSERT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_EQ(frame.truth.labels(1, 1), 1);
  EXPECT_EQ(frame.truth.labels(1, 9), 2);
  EXPECT_EQ(frame.truth.labels(1, 17), 1);
  EXPECT_EQ(frame.truth.labels(10, 10), 0);
}

TEST_F(OsdSourceTest, FramesThatDoNotFitAreNamed) {
  put_depth("depth/a.png", 800);
  put_depth("depth/b.png", 800);
  put_labels("a.png", 1, {12, 10});
  put_bytes("point_cloud/c.pcd", write_pcd(cv::Mat1f(10, 12, 900.0F), kOsdCamera, PcdEncoding::ascii));
  put_bytes("point_cloud/d.pcd", {1, 2, 3});
  put_labels("b.png", 1);
  const auto source = open();
  Frame frame;
  const ReadResult a = source->read(frame, kNoWait);
  EXPECT_EQ(a.status, ReadStatus::frame) << "labels do not cost the depth";
  EXPECT_EQ(a.reason, "no labels: a.png: 12x10, but the depth is 24x20");
  EXPECT_TRUE(frame.truth.labels.empty());
  EXPECT_EQ(source->read(frame, kNoWait).status, ReadStatus::frame);
  EXPECT_THAT(source->read(frame, kNoWait).reason, HasSubstr("c.pcd: 12x10, but the first frame is 24x20"));
  EXPECT_THAT(source->read(frame, kNoWait).reason, HasSubstr("d.pcd: not a sound PCD"));
}

TEST_F(OsdSourceTest, NoFrames) {
  fs::create_directories(folder_ / "annotation");
  fs::create_directories(folder_ / "depth");
  EXPECT_THROW(open(), Error);
}

}  // namespace
}  // namespace saccade
