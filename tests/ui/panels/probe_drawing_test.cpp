#include "ui/panels/probe_drawing.hpp"

#include <gtest/gtest.h>

#include "tests/saliency/shapes.hpp"
#include "tests/ui/support/imgui_frames.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {
namespace {

const cv::Size kSize(160, 120);

ProbeShown ridge_probe(int row, int col) {
  const Intrinsics camera = test::camera_for(kSize);
  const cv::Mat1f depth = test::ridge_depth(kSize, camera, 1000, 0.6);
  ProbeShown shown;
  shown.probe = probe(depth, camera, {.kernel = 9, .first_level = 0, .last_level = 2}, row, col);
  shown.camera = camera;
  shown.saliency = shown.probe.saliency;
  shown.model = "symmetry3d";
  return shown;
}

TEST(ProbePanel, FitsASideBar) {
  for (const float font_px : {13.0F, 26.0F}) {
    test::ImGuiFrames frames(font_px * 340 / 13, 1800, font_px);
    ProbePanelState state;
    for (const auto& shown : {std::optional(ridge_probe(60, 80)), std::optional<ProbeShown>()}) {
      const auto draw = [&] { draw_probe(shown, state); };
      frames.frame(draw);
      const auto drawn = frames.frame(draw);
      EXPECT_LE(drawn.content_width, drawn.window_width + 1);
      EXPECT_GT(drawn.vertices, 50);
    }
  }
}

TEST(ProbePanel, ListsTheLevelThatAddsMostUnlessOneIsChosen) {
  const ProbeShown shown = ridge_probe(60, 80);
  const int most = listed_level(shown.probe, {});
  for (const LevelProbe& level : shown.probe.levels)
    EXPECT_GE(shown.probe.levels[static_cast<std::size_t>(most)].contribution, level.contribution);
  EXPECT_EQ(listed_level(shown.probe, {.level = 2}), 2);
  EXPECT_EQ(listed_level(shown.probe, {.level = 7}), most) << "a level that is not there";
  EXPECT_EQ(listed_level({}, {}), -1);
}

TEST(ProbePanel, FootprintsAreWhereTheWindowsAre) {
  test::ImGuiFrames frames(400, 300);
  const ProbeShown shown = ridge_probe(60, 80);
  PicturePlace place{{40, 30}, {0, 0}, {400, 300}, 2};
  frames.frame([&] { draw_footprints(*ImGui::GetWindowDrawList(), shown, {}, place); });
  ImVec2 low, high;
  // Level 0: 9 px around (60, 80), twice as large on the screen.
  ASSERT_TRUE(test::ImGuiFrames::box_of(series_colour(0), low, high));
  EXPECT_NEAR(low.x, 40 + 2 * 76, 2);
  EXPECT_NEAR(high.x, 40 + 2 * 85, 2);
  EXPECT_NEAR(low.y, 30 + 2 * 56, 2);
  EXPECT_NEAR(high.y, 30 + 2 * 65, 2);
  ASSERT_TRUE(test::ImGuiFrames::box_of(series_colour(2), low, high));
  EXPECT_NEAR(high.y - low.y, 2 * 36, 4) << "level 2 is four times as large";
}

TEST(PlaneTrace, FollowsTheRidge) {
  const ProbeShown shown = ridge_probe(60, 80);
  const LevelProbe& level = shown.probe.levels[0];
  ASSERT_TRUE(level.winner().has_value());
  const auto& gamma = level.symmetry->planes[*level.winner()].gamma;
  const auto trace = plane_trace({gamma.x(), gamma.y(), gamma.z()}, *shown.probe.normal,
                                 shown.probe.position_mm, 100, shown.camera);
  ASSERT_TRUE(trace.has_value());
  EXPECT_NEAR(trace->first.x, trace->second.x, 1.5) << "the edge is vertical";
  EXPECT_NEAR(std::abs(trace->first.y - trace->second.y), 100 / 1000.0 * shown.camera.fy, 1.5);
  EXPECT_FALSE(plane_trace({0, 0, 1}, {0, 0, -1}, {0, 0, 1000}, 100, shown.camera)) << "lies in the surface";
  EXPECT_FALSE(plane_trace({0, 1, 0}, {1, 0, 0}, {0, 0, 10}, 100, shown.camera)) << "behind the camera";
}

}  // namespace
}  // namespace saccade
