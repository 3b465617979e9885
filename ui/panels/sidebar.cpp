#include <array>

#include <imgui.h>

#include "ui/panels/panels.hpp"

namespace saccade {
namespace {

// The panels from top to bottom; a new one is a line here and one in Sidebar::draw_panel().
struct SidebarEntry {
  SidebarPanel panel;
  const char *title, *explanation;
};
constexpr std::array<SidebarEntry, kSidebarPanels> kSidebar = {
    {{SidebarPanel::tuning, "Tuning", "The settings of model and attention"},
     {SidebarPanel::display, "Display", "Colours, ranges and marks of the picture"},
     {SidebarPanel::fixations, "Fixations", "A table of the marks on the picture"},
     {SidebarPanel::probe, "Probe", "Why a pixel has its saliency: levels and symmetry planes"},
     {SidebarPanel::performance, "Performance", "Frame rate, latency, and the time of every stage"},
     {SidebarPanel::sensors, "Sensors and recording",
      "Connected sensors, their controls, and files that are written"}}};

}  // namespace

void Sidebar::draw(ViewContext& view) {
  view.hovered_row = -1;
  for (const SidebarEntry& s : kSidebar) {
    ImGui::PushID(s.title);
    ImGui::SetNextItemOpen(view.state.is_open(s.panel));
    ImGui::PushFont(view.fonts.bold);
    const bool open = ImGui::CollapsingHeader(s.title);
    ImGui::PopFont();
    explain(s.explanation);
    view.state.is_open(s.panel) = open;
    if (open) {
      ImGui::Dummy({0, view.px(1)});
      draw_panel(view, s.panel);
      ImGui::Dummy({0, view.px(6)});
    }
    ImGui::PopID();
  }
}

void Sidebar::draw_panel(ViewContext& view, SidebarPanel panel) {
  switch (panel) {
    case SidebarPanel::tuning:
      return draw_tuning_panel(view);
    case SidebarPanel::display:
      return draw_display_panel(view);
    case SidebarPanel::fixations:
      return fixations_.draw(view);
    case SidebarPanel::probe:
      return probe_.draw(view);
    case SidebarPanel::performance:
      return draw_performance_panel(view);
    case SidebarPanel::sensors:
      return sensors_.draw(view);
    case SidebarPanel::count:
      return;
  }
}

}  // namespace saccade
