#include <array>

#include <imgui.h>

#include "ui/panels/panels.hpp"

namespace saccade {
namespace {

// The sections from top to bottom; a new one is a new line here and in Sidebar::draw_panel().
struct SidebarEntry {
  SidebarPanel section;
  const char* title;
};
constexpr std::array<SidebarEntry, kSidebarPanels> kSidebar = {
    {{SidebarPanel::tuning, "Tuning"},
     {SidebarPanel::display, "Picture"},
     {SidebarPanel::probe, "Probe"},
     {SidebarPanel::performance, "Performance"},
     {SidebarPanel::sensors, "Sensors and recording"}}};

}  // namespace

void Sidebar::draw(ViewContext& view) {
  for (const SidebarEntry& s : kSidebar) {
    ImGui::PushID(s.title);
    ImGui::SetNextItemOpen(view.state.is_open(s.section));
    ImGui::PushFont(view.fonts.bold);
    const bool open = ImGui::CollapsingHeader(s.title);
    ImGui::PopFont();
    view.state.is_open(s.section) = open;
    if (s.section == SidebarPanel::sensors) sensors_.set_open(open);
    if (open) {
      ImGui::Dummy({0, view.px(1)});
      draw_panel(view, s.section);
      ImGui::Dummy({0, view.px(6)});
    }
    ImGui::PopID();
  }
}

void Sidebar::draw_panel(ViewContext& view, SidebarPanel section) {
  switch (section) {
    case SidebarPanel::tuning:
      return draw_tuning_panel(view);
    case SidebarPanel::display:
      return draw_display_panel(view);
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
