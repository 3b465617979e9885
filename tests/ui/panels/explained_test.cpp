// Every control has a tool tip: the mouse goes over all of a panel, and wherever something can be clicked or
// dragged, a tool tip must be shown.
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "panel_test.hpp"
#include "ui/panels/cloud_drawing.hpp"
#include "ui/panels/open_dialog.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/settings_dialog.hpp"

namespace saccade {
namespace {

class ExplainedTest : public ViewerPanelsTest {
 protected:
  explicit ExplainedTest(float width = 332, float height = 900) : ViewerPanelsTest(width, height) {
    show_result();
  }

  static bool tool_tip() {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0) return true;
    return false;
  }

  // Scroll bars, the cross of a dialog, and the point cloud, over which a tool tip would be in the way.
  static bool own_control(ImGuiID id) {
    ImGuiWindow* window = ImGui::GetCurrentContext()->HoveredWindow;
    if (window == nullptr) return false;
    return id == ImGui::GetWindowScrollbarID(window, ImGuiAxis_X) || id == window->GetID("#CLOSE") ||
           id == ImGui::GetWindowScrollbarID(window, ImGuiAxis_Y) ||
           std::string(window->Name).find("/points") != std::string::npos;
  }

  // Returns the number of controls.
  std::size_t expect_explained(const Draw& draw) {
    settled(draw);
    ImGuiIO& io = ImGui::GetIO();
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    std::set<ImGuiID> seen;
    for (float y = 4; y < io.DisplaySize.y; y += 8)
      for (float x = 4; x < io.DisplaySize.x; x += 10) {
        io.MousePos = {x, y};
        frames_.frame(draw);
        const ImGuiID hovered = context.HoveredId;
        const ImGuiWindow* window = context.HoveredWindow;
        if (hovered == 0 || own_control(hovered) || !seen.insert(hovered).second) continue;
        EXPECT_TRUE(tool_tip()) << "nothing explains what is at " << x << ", " << y << " of "
                                << (window != nullptr ? window->Name : "");
      }
    return seen.size();
  }
};

TEST_F(ExplainedTest, Tuning) {
  const Draw draw = [this] { draw_tuning_panel(view_); };
  state_.comparison = Comparison::split;
  EXPECT_GT(expect_explained(draw), 20u);
  state_.settings.a.selector = Selector::wta;
  expect_explained(draw);
  state_.settings.a.model = "itti";
  expect_explained(draw);
}

TEST_F(ExplainedTest, Display) {
  const Draw draw = [this] { draw_display_panel(view_); };
  state_.comparison = Comparison::split;
  state_.style.background = Background::depth;
  EXPECT_GT(expect_explained(draw), 14u);
  state_.style.depth.range_mm = ValueRange{500, 2000};
  state_.style.map.range = ValueRange{0, 1};
  expect_explained(draw);
}

TEST_F(ExplainedTest, FixationsAndSensors) {
  FixationPanel fixations;
  view_.lock.lock(view_.result->a.result.attention.fixations[0]);
  EXPECT_GT(expect_explained([&] { fixations.draw(view_); }), 9u);
  SensorFacts facts;
  facts.source = {.open = true, .uri = "openni2:1", .live = true, .rate_hz = 30};
  facts.devices = {{"Xtion", "openni2:2", "PS1080"}};
  facts.modes = {{640, 480, 30}, {320, 240, 30}};
  facts.values = {true, false, false, 20, true};
  EXPECT_GT(expect_explained([&] { (void)draw_sensors(facts, {}); }), 8u);
  view_.file_dialog = [](const FileDialog&, auto) {};
  SensorPanel sensors([] { return std::vector<DeviceChoice>(); }, [] {});
  EXPECT_GT(expect_explained([&] { sensors.draw(view_); }), 3u);
}

TEST_F(ExplainedTest, Sidebar) {
  Sidebar sidebar([] { return std::vector<DeviceChoice>(); }, [] {});
  state_.open.fill(false);
  EXPECT_EQ(expect_explained([&] { sidebar.draw(view_); }), kSidebarPanels);
}

class WideExplainedTest : public ExplainedTest {
 protected:
  WideExplainedTest() : ExplainedTest(900, 420) {}
};

TEST_F(WideExplainedTest, TopBarTransportAndMessages) {
  view_.source.uri = "/data/table.oni";
  EXPECT_GT(expect_explained([this] { draw_top_bar(view_); }), 9u);
  EXPECT_GT(expect_explained([this] { draw_transport(view_); }), 9u);
  view_.source.phase = SessionState::Phase::ended;
  view_.errors = {"a", "b", "c", "d"};
  view_.notes = {"a note"};
  view_.recorded = "a.oni";
  view_.connected = {{"Xtion", "openni2:1", ""}};
  EXPECT_GT(expect_explained([this] { draw_messages(view_); }), 16u);
  view_.welcome = true;
  EXPECT_GT(expect_explained([this] { draw_welcome(view_, {0, 0}, {900, 420}); }), 3u);
}

TEST_F(WideExplainedTest, Points) {
  CloudPanelState state;
  const Draw draw = [&] {
    draw_cloud(state_.cloud, state, view_.result->frame(), view_.result->a.result.attention,
               [](cv::Size) { return ImTextureID(2); });
  };
  state.placed = true;
  settled(draw);
  EXPECT_GT(expect_explained(draw), 5u);
}

TEST_F(WideExplainedTest, Dialogs) {
  view_.file_dialog = [](const FileDialog&, auto) {};
  view_.example = "/data/table.oni";
  view_.sensors.devices = {{"Xtion", "openni2:1", "PS1080"}};
  SettingsDialog settings;
  settings.show();
  EXPECT_GT(expect_explained([&] { settings.draw(view_); }), 5u);
}

}  // namespace
}  // namespace saccade
