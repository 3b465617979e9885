#include <array>

#include <imgui.h>

#include "ui/viewer/panels.hpp"

namespace saccade {
namespace {

// The sections from top to bottom; a new one is a new line here and in Sidebar::draw_section().
struct SidebarSection {
  Section section;
  const char* title;
};
constexpr std::array<SidebarSection, kSections> kSidebar = {{{Section::tuning, "Tuning"},
                                                             {Section::look, "Picture"},
                                                             {Section::probe, "Probe"},
                                                             {Section::performance, "Performance"},
                                                             {Section::sensors, "Sensors and recording"}}};

}  // namespace

void Sidebar::draw(ViewContext& view) {
  for (const SidebarSection& s : kSidebar) {
    ImGui::PushID(s.title);
    ImGui::SetNextItemOpen(view.state.is_open(s.section));
    ImGui::PushFont(view.fonts.bold);
    const bool open = ImGui::CollapsingHeader(s.title);
    ImGui::PopFont();
    view.state.is_open(s.section) = open;
    if (s.section == Section::sensors) sensors_.set_open(open);
    if (open) {
      ImGui::Dummy({0, view.px(1)});
      draw_section(view, s.section);
      ImGui::Dummy({0, view.px(6)});
    }
    ImGui::PopID();
  }
}

void Sidebar::draw_section(ViewContext& view, Section section) {
  switch (section) {
    case Section::tuning:
      return draw_tuning_panel(view);
    case Section::look:
      return draw_look_panel(view);
    case Section::probe:
      return probe_.draw(view);
    case Section::performance:
      return draw_performance_section(view);
    case Section::sensors:
      return sensors_.draw(view);
    case Section::count:
      return;
  }
}

}  // namespace saccade
