#include "ui/panels/performance_drawing.hpp"

#include <gtest/gtest.h>

#include "tests/ui/support/imgui_frames.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

StageTimes times_of(double points_ms, double symmetry_ms) {
  StageTimes times;
  times[Stage::points] = points_ms;
  times[Stage::symmetry] = symmetry_ms;
  return times;
}

// The plot's bars of a stage: right of the swatches of the table.
float height_of_bars(Stage stage) {
  float low = 1e9F, high = 0;
  const ImU32 colour = series_colour(static_cast<int>(stage));
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i)
    for (const ImDrawVert& vertex : data.CmdLists[i]->VtxBuffer)
      if (vertex.col == colour && vertex.pos.x > 100) {
        low = std::min(low, vertex.pos.y);
        high = std::max(high, vertex.pos.y);
      }
  return high - low;
}

TEST(PerformancePanel, BarsAreAsHighAsTheStagesAreLong) {
  test::ImGuiFrames frames;
  StageHistory history(100);
  for (int i = 0; i < 50; ++i) history.add(times_of(5, 15), 30, {});
  const auto draw = [&] { draw_performance(history, {.simd = "auto"}, {}); };
  frames.frame(draw);
  const auto drawn = frames.frame(draw);
  EXPECT_LE(drawn.content_width, drawn.window_width + 1) << "nothing is cut off";
  EXPECT_NEAR(height_of_bars(Stage::symmetry) / height_of_bars(Stage::points), 3, 0.05);
}

TEST(PerformancePanel, WithoutFramesThereIsAPanelWithoutBars) {
  test::ImGuiFrames frames;
  const StageHistory history;
  frames.frame([&] { draw_performance(history, {}, {}); });
  const auto drawn = frames.frame([&] { draw_performance(history, {}, {}); });
  EXPECT_GT(drawn.vertices, 500) << "the tables stand";
  EXPECT_LT(height_of_bars(Stage::symmetry), 0);
}

TEST(PerformancePanel, AxesEndAtRoundNumbers) {
  EXPECT_EQ(axis_end(0.7), 1);
  EXPECT_EQ(axis_end(1), 1);
  EXPECT_EQ(axis_end(13), 20);
  EXPECT_EQ(axis_end(21), 50);
  EXPECT_EQ(axis_end(700), 1000);
}

}  // namespace
}  // namespace saccade
