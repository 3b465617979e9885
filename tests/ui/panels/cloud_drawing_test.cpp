#include "ui/panels/cloud_drawing.hpp"

#include <gtest/gtest.h>

#include "tests/ui/support/imgui_frames.hpp"

namespace saccade {
namespace {

class CloudDrawingTest : public ::testing::Test {
 protected:
  CloudDrawingTest() {
    frame_.depth_mm = cv::Mat1f(480, 640, 1000.0F);
    frame_.intrinsics = {525, 525, 319.5, 239.5};
    attention_.fixations.push_back({240, 320, 1, {0, 0, 1000}, {}});
  }

  test::ImGuiFrames::Drawn draw() {
    return frames_.frame([this] {
      draw_cloud(choices_, state_, frame_, attention_, [this](cv::Size size) {
        size_ = size;
        return ImTextureID(2);
      });
    });
  }

  void drag(ImGuiMouseButton button, ImVec2 from, ImVec2 to) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = from;
    draw();
    io.MouseDown[button] = true;
    draw();
    io.MousePos = to;
    draw();
    io.MouseDown[button] = false;
    draw();
  }

  test::ImGuiFrames frames_{640, 520};
  CloudStyle choices_;
  CloudPanelState state_;
  Frame frame_;
  Attention attention_;
  cv::Size size_;
};

TEST_F(CloudDrawingTest, BeginsAtTheSensorAndFillsTheRoom) {
  draw();
  const auto drawn = draw();
  EXPECT_TRUE(state_.placed);
  EXPECT_EQ(state_.camera.eye_mm(), cv::Vec3d());
  EXPECT_GT(size_.width, 600);
  EXPECT_GT(size_.height, 440);
  EXPECT_LE(drawn.content_width, drawn.window_width + 1);
}

TEST_F(CloudDrawingTest, ATitleStandsBesideTheChoices) {
  draw();
  EXPECT_EQ(state_.title_place.name, "");
  state_.title = "of A";
  draw();
  EXPECT_GT(state_.title_place.high.x, state_.title_place.low.x);
  EXPECT_LT(state_.title_place.high.y, 520.0F - static_cast<float>(size_.height) + 1);
}

TEST_F(CloudDrawingTest, DragsTurnAndMoveAndADoubleClickGoesBack) {
  draw();
  drag(ImGuiMouseButton_Left, {300, 300}, {360, 300});
  EXPECT_LT(state_.camera.eye_mm()[0], -10);
  EXPECT_EQ(state_.camera.target_mm(), cv::Vec3d(0, 0, 1000));
  drag(ImGuiMouseButton_Right, {300, 300}, {360, 300});
  EXPECT_LT(state_.camera.target_mm()[0], -10);
  ImGui::GetIO().MouseDoubleClickTime = 10;
  for (int i = 0; i < 2; ++i) drag(ImGuiMouseButton_Left, {300, 300}, {300, 300});
  EXPECT_EQ(state_.camera.eye_mm(), cv::Vec3d());
}

TEST_F(CloudDrawingTest, TheWheelComesNearer) {
  draw();
  ImGui::GetIO().MousePos = {300, 300};
  draw();
  ImGui::GetIO().MouseWheel = 1;
  draw();
  EXPECT_NEAR(state_.camera.distance_mm(), 900, 1e-6);
}

TEST_F(CloudDrawingTest, FixationsAreMarkedWhereTheyAre) {
  draw();
  draw();
  ImVec2 low, high;
  ASSERT_TRUE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 255), low, high));
  EXPECT_NEAR((low.y + high.y) / 2, 520 - 8 - size_.height / 2.0, 3) << "the middle of the canvas";
  EXPECT_LT(low.x, 320);
  EXPECT_GT(high.x, 320 + 60) << "with its position beside it";
  choices_.fixations = false;
  draw();
  EXPECT_FALSE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 255), low, high));
}

TEST_F(CloudDrawingTest, AClickFindsTheMarkOrThePixelUnderIt) {
  draw();
  draw();
  const auto click_at = [&](ImVec2 at) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    draw();
    io.MouseDown[0] = true;
    draw();
    io.MouseDown[0] = false;
    draw();
  };
  ImVec2 low, high;
  ASSERT_TRUE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 255), low, high));
  const ImVec2 mark{low.x + 10, (low.y + high.y) / 2};
  click_at(mark);
  EXPECT_TRUE(state_.clicked);
  EXPECT_EQ(state_.hovered_mark, 0);
  EXPECT_FALSE(state_.clicked_pixel);
  click_at({mark.x - 100, mark.y + 50});
  ASSERT_TRUE(state_.clicked_pixel);
  EXPECT_EQ(state_.hovered_mark, -1);
  const auto at = state_.camera.project(
      frame_.intrinsics.point_mm(state_.clicked_pixel->y, state_.clicked_pixel->x, 1000), size_);
  EXPECT_NEAR(at->x, mark.x - 100 - 8, 6);
  EXPECT_NEAR(at->y, mark.y + 50 - static_cast<float>(520 - 8 - size_.height), 6);
  drag(ImGuiMouseButton_Left, {300, 300}, {330, 300});
  EXPECT_FALSE(state_.clicked) << "that was a drag";
}

TEST_F(CloudDrawingTest, AMarkerBehindASurfaceIsFaint) {
  frame_.depth_mm = 500;  // the fixation is at 1000 mm
  draw();
  ImVec2 low, high;
  EXPECT_TRUE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 255), low, high)) << "the sensor's own view";
  drag(ImGuiMouseButton_Left, {300, 300}, {303, 300});
  EXPECT_FALSE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 255), low, high));
  EXPECT_TRUE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 90), low, high));
}

TEST_F(CloudDrawingTest, ADistanceIsDrawnBetweenItsEnds) {
  state_.measured = {{-100, 0, 1000}, {100, 0, 1000}};
  draw();
  draw();
  ImVec2 low, high;
  ASSERT_TRUE(test::ImGuiFrames::box_of(IM_COL32(0, 0, 0, 190), low, high)) << "its length";
  EXPECT_NEAR(low.x, 320, 10) << "in the middle between them";
}

TEST_F(CloudDrawingTest, AFixationWithoutAReadingHasNoMarker) {
  attention_.fixations[0].position_mm = {};
  draw();
  ImVec2 low, high;
  EXPECT_FALSE(test::ImGuiFrames::box_of(IM_COL32(80, 255, 80, 255), low, high));
}

}  // namespace
}  // namespace saccade
