#include "ui/session/cloud_vertices.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace saccade {
namespace {

static_assert(sizeof(CloudVertex) == 20);

class PointCloudTest : public ::testing::Test {
 protected:
  PointCloudTest() {
    frame_.intrinsics = {100, 100, 19.5, 14.5};
    frame_.depth_mm = cv::Mat1f(30, 40, 1000.0F);
    frame_.colour = cv::Mat3b(30, 40, cv::Vec3b(10, 20, 30));
  }
  Frame frame_;
};

TEST_F(PointCloudTest, APointForEachReading) {
  frame_.depth_mm(0, 0) = 0;
  frame_.colour(0, 1) = {1, 2, 3};
  std::vector<CloudVertex> cloud;
  build_cloud(frame_, frame_.colour, {}, cloud);
  ASSERT_EQ(cloud.size(), 30U * 40 - 1);
  const cv::Point3d p = frame_.intrinsics.point_mm(0, 1, 1000);
  EXPECT_NEAR(cloud[0].position_mm[0], p.x, 1e-3);
  EXPECT_NEAR(cloud[0].position_mm[1], p.y, 1e-3);
  EXPECT_EQ(cloud[0].position_mm[2], 1000);
  EXPECT_EQ(cloud[0].colour, (std::array<std::uint8_t, 4>{3, 2, 1, 255}));
  EXPECT_EQ(cloud[0].normal, (std::array<std::int8_t, 4>{}));
}

TEST_F(PointCloudTest, RoughNormalsFaceTheCamera) {
  // The plane n.p = 800 with n = (0.6, 0, 0.8); its normal towards the camera is -n.
  for (int r = 0; r < 30; ++r)
    for (int c = 0; c < 40; ++c) {
      const cv::Point3d ray = frame_.intrinsics.point_mm(r, c, 1);
      frame_.depth_mm(r, c) = static_cast<float>(800 / (0.6 * ray.x + 0.8));
    }
  const cv::Mat3f normals = rough_normals(frame_.depth_mm, frame_.intrinsics);
  EXPECT_NEAR(normals(15, 20)[0], -0.6, 1e-3);
  EXPECT_NEAR(normals(15, 20)[1], 0, 1e-3);
  EXPECT_NEAR(normals(15, 20)[2], -0.8, 1e-3);
  EXPECT_EQ(normals(0, 20), cv::Vec3f()) << "none at the border";

  std::vector<CloudVertex> cloud;
  build_cloud(frame_, frame_.colour, normals, cloud);
  EXPECT_EQ(cloud[15 * 40 + 20].normal, (std::array<std::int8_t, 4>{-76, 0, -102, 0}));
}

TEST_F(PointCloudTest, NoRoughNormalBesideAHoleOrAJump) {
  frame_.depth_mm(10, 10) = 0;
  frame_.depth_mm(20, 20) = 1100;
  const cv::Mat3f normals = rough_normals(frame_.depth_mm, frame_.intrinsics);
  for (const cv::Point at : {cv::Point(10, 10), cv::Point(11, 10), cv::Point(10, 9), cv::Point(20, 20),
                             cv::Point(19, 20), cv::Point(20, 21)})
    EXPECT_EQ(normals(at), cv::Vec3f()) << at;
  EXPECT_NE(normals(15, 15), cv::Vec3f());
}

TEST_F(PointCloudTest, ColoursAreThoseOfImageDepthOrMap) {
  OverlayStyle style;
  style.background = Background::depth;  // of the picture, not of the cloud
  EXPECT_EQ(cloud_colours(CloudColour::image, frame_, {}, style)(3, 3), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(cloud_colours(CloudColour::depth, frame_, {}, style)(3, 3), depth_picture(frame_.depth_mm)(3, 3));
  cv::Mat1f map(frame_.size(), 0.0F);
  map(3, 3) = 2;
  const cv::Mat3b by_map = cloud_colours(CloudColour::saliency, frame_, map, style);
  cv::Mat3b expected = cloud_colours(CloudColour::image, frame_, {}, style);
  blend_map(expected, shown_strength(map, style.map), style.map);
  EXPECT_EQ(by_map(3, 3), expected(3, 3));
  EXPECT_NE(by_map(3, 3), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(by_map(9, 9), cv::Vec3b(10, 20, 30));
  EXPECT_EQ(cloud_colours(CloudColour::saliency, frame_, {}, style)(3, 3), cv::Vec3b(10, 20, 30));
}

TEST_F(PointCloudTest, NormalLinesStandOnTheirPoints) {
  const cv::Mat3f normals(frame_.size(), cv::Vec3f(0, 0, -1));
  std::vector<CloudVertex> lines;
  build_normal_lines(frame_, normals, 10, 25, lines);
  ASSERT_EQ(lines.size(), 2U * 3 * 4);
  EXPECT_EQ(lines[0].position_mm[2], 1000);
  EXPECT_EQ(lines[1].position_mm[2], 975);
}

TEST_F(PointCloudTest, SizesThatDifferAreRefused) {
  std::vector<CloudVertex> cloud;
  EXPECT_THROW(build_cloud(frame_, cv::Mat3b(3, 3), {}, cloud), std::invalid_argument);
  EXPECT_THROW(build_cloud(frame_, frame_.colour, cv::Mat3f(3, 3), cloud), std::invalid_argument);
  EXPECT_THROW(cloud_colours(CloudColour::saliency, frame_, cv::Mat1f(3, 3), {}), std::invalid_argument);
  EXPECT_THROW(build_normal_lines(frame_, cv::Mat3f(30, 40), 0, 1, cloud), std::invalid_argument);
}

}  // namespace
}  // namespace saccade
