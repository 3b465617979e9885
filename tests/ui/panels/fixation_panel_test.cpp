// The table of fixations, drawn without a display.
#include "ui/panels/fixation_panel.hpp"

#include <gmock/gmock.h>

#include "panel_test.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

class FixationPanelTest : public ViewerPanelsTest {
 protected:
  FixationPanelTest() { show_result(); }
  // A click on the row of fixation `rank`.
  void click_row(const char* place) { click(place, draw_, 0.5F); }
  FixationPanel panel_;
  const Draw draw_ = [this] { panel_.draw(view_); };
};

TEST_F(FixationPanelTest, AClickLocksAFixationAndAnotherFreesIt) {
  click_row("fixation 2");
  ASSERT_TRUE(view_.lock.locked());
  view_.locked = view_.lock.find(view_.result->a.result.attention.fixations);
  EXPECT_EQ(view_.locked, 1);
  for (int i = 0; i < 40; ++i) frames_.frame(draw_);  // else it is a double click
  click_row("fixation 2");
  EXPECT_FALSE(view_.lock.locked());
}

TEST_F(FixationPanelTest, ADoubleClickCentres) {
  click_row("fixation 1");
  click_row("fixation 1");
  ASSERT_TRUE(view_.centre_on.has_value());
  EXPECT_EQ(view_.centre_on->col, 200);
}

TEST_F(FixationPanelTest, HoveringPointsOutTheMark) {
  settled(draw_);
  const auto [left, top, right, bottom] = view_.places.at("fixation 2");
  ImGui::GetIO().MousePos = {(left + right) / 2, (top + bottom) / 2};
  settled(draw_);
  EXPECT_EQ(view_.hovered_row, 1);
}

TEST_F(FixationPanelTest, FitsIntoTheSideBarAndSaysWhenThereIsNothing) {
  expect_fits(draw_);
  view_.result = nullptr;
  settled(draw_);
  ImVec2 low, high;
  EXPECT_TRUE(ImGuiFrames::box_of(ImGui::GetColorU32(tone_colour(Tone::quiet)), low, high));
}

TEST(SaliencyText, HasTheSameDigitsEverywhere) {
  EXPECT_EQ(saliency_text(1.3496F), "1.35");
  EXPECT_EQ(saliency_text(0.0102F), "0.01");
  EXPECT_EQ(saliency_text(0.0019F), "0.002");
  EXPECT_EQ(saliency_text(3.5e-8F), "0");
  EXPECT_EQ(saliency_text(0), "0");
}

TEST_F(FixationPanelTest, OverTimeItSaysHowOftenAnObjectWasLookedAt) {
  auto result = std::make_shared<ViewResult>(*view_.result);
  Computed& a = result->a;
  for (Fixation& fixation : a.result.attention.fixations) fixation.position_mm = {-999, -999, 8000};
  a.result.attention.sequence.emplace();
  a.marks.emplace();
  a.marks->marks = {{{}, false, 1, 1}, {{}, true, 12, 100}};
  view_.result = result;
  expect_fits(draw_);
  const ImGuiTable* table = ImGui::TableFindByID(ImGui::FindWindowByName("panel")->GetID("objects"));
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->ColumnsCount, 8);
  for (int i = 0; i < 8; ++i) {
    const ImGuiTableColumn& column = table->Columns[i];
    EXPECT_LE(column.ContentMaxXUnfrozen, column.ClipRect.Max.x + 1) << "column " << i << " is cut off";
  }
}

TEST(ObjectText, SaysWhatIsKnown) {
  Computed computed;
  computed.result.attention.fixations.resize(2);
  Fixation& fixation = computed.result.attention.fixations[1];
  fixation.id = 7;
  fixation.age_frames = 96;
  fixation.world_mm = {10, -20, 1000};
  computed.result.attention.sequence.emplace();
  computed.marks.emplace();
  computed.marks->marks = {{}, {{}, true, 2, 3.25}};
  EXPECT_EQ(
      object_text(computed, 1),
      "Object 7, rank 2, looked at a moment ago\nknown for 3.2 s, seen in 96 frames\nlooked at 2 times\n"
      "world 10, -20, 1000 mm");
  computed.marks->marks[1].looks = 0;
  fixation.age_frames = 1;
  EXPECT_THAT(object_text(computed, 1), ::testing::HasSubstr("seen in 1 frame\nnot looked at yet\n"));
  computed.result.attention.sequence->gaze = 7;
  EXPECT_THAT(object_text(computed, 1), ::testing::HasSubstr("looked at now"));
}

TEST(FixationText, HasALineForEach) {
  Fixation fixation;
  fixation.id = 7;
  fixation.row = 3;
  fixation.col = 4;
  fixation.saliency = 0.5F;
  fixation.confidence = 0.875F;
  fixation.position_mm = {1, -2, 1000};
  fixation.proto_object.extent_mm = {10, 30, 20};
  Computed computed;
  computed.result.attention.fixations = {fixation};
  const std::string heading = "rank\tid\trow\tcol\tx_mm\ty_mm\tz_mm\tsize_mm\tsaliency\tconfidence\tlooks\n";
  EXPECT_EQ(fixation_text(computed), heading + "1\t7\t3\t4\t1.0\t-2.0\t1000.0\t30.0\t0.5\t0.875\t\n");
  computed.marks.emplace();
  computed.marks->marks = {{{}, true, 2, 3.25}};
  EXPECT_EQ(fixation_text(computed), heading + "1\t7\t3\t4\t1.0\t-2.0\t1000.0\t30.0\t0.5\t0.875\t2\n");
}

}  // namespace
}  // namespace saccade
