#include "ui/overlay.hpp"

#include <gtest/gtest.h>

#include "ui/colour_map.hpp"

namespace saccade {
namespace {

TEST(ColourMap, GrayIsTheRootOfTheShareOfTheLargestValue) {
  const cv::Mat1b gray = to_gray((cv::Mat1f(1, 3) << 0, 0.5, 2));
  EXPECT_EQ(gray(0), 0);
  EXPECT_EQ(gray(1), 128);
  EXPECT_EQ(gray(2), 255);
  EXPECT_EQ(cv::countNonZero(to_gray(cv::Mat1f(4, 4, 0.0F))), 0);
}

TEST(ColourMap, NearDepthIsBrighterAndNoReadingIsBlack) {
  cv::Mat1f depth(20, 20, 1000.0F);
  depth.rowRange(10, 20) = 2000.0F;
  depth(0, 0) = 0;
  const cv::Mat3b picture = depth_picture(depth);
  EXPECT_GT(picture(5, 5)[0], picture(15, 5)[0]);
  EXPECT_GT(picture(15, 5)[0], 0);
  EXPECT_EQ(picture(0, 0), cv::Vec3b());
  EXPECT_EQ(cv::norm(depth_picture(cv::Mat1f(8, 8, 0.0F))), 0);
}

class OverlayTest : public ::testing::Test {
 protected:
  OverlayTest() {
    frame_.depth_mm = cv::Mat1f(120, 160, 1000.0F);
    frame_.colour = cv::Mat3b(120, 160, cv::Vec3b(40, 50, 60));
    attention_.fixations.push_back({60, 80, 1, {}, {}});
    attention_.masks = cv::Mat1w(120, 160, std::uint16_t{0});
    attention_.masks(cv::Rect(20, 20, 10, 10)) = 1;
  }
  Frame frame_;
  Attention attention_;
  cv::Mat1f saliency_ = cv::Mat1f(120, 160, 0.0F);
};

TEST_F(OverlayTest, LeavesWhatIsNotSalientAsItWas) {
  const cv::Mat3b picture = draw_overlay(frame_, saliency_, attention_);
  EXPECT_EQ(picture(100, 10), cv::Vec3b(40, 50, 60));
  EXPECT_EQ(frame_.colour(60, 80), cv::Vec3b(40, 50, 60)) << "the frame itself is not drawn on";
}

TEST_F(OverlayTest, MarksFixationsOutlinesObjectsAndColoursTheMap) {
  saliency_(100, 140) = 2;
  const cv::Mat3b picture = draw_overlay(frame_, saliency_, attention_);
  EXPECT_NE(picture(60, 74), cv::Vec3b(40, 50, 60)) << "the mark's disc";
  EXPECT_NE(picture(20, 25), cv::Vec3b(40, 50, 60)) << "the outline";
  EXPECT_EQ(picture(25, 25), cv::Vec3b(40, 50, 60)) << "not the inside";
  EXPECT_GT(picture(100, 140)[2], 60) << "red is most salient";

  OverlayStyle plain;
  plain.marks = plain.outlines = false;
  plain.map_opacity = 0;
  EXPECT_EQ(cv::norm(draw_overlay(frame_, saliency_, attention_, plain), frame_.colour), 0);
}

TEST_F(OverlayTest, DepthStandsInForColour) {
  frame_.colour.release();
  EXPECT_EQ(draw_overlay(frame_, saliency_, attention_).size(), cv::Size(160, 120));
}

}  // namespace
}  // namespace saccade
