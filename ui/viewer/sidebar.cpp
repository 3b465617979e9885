#include <array>

#include <imgui.h>

#include "ui/viewer/panels.hpp"

namespace saccade {
namespace {

// The sections of the side bar from top to bottom; a new panel is a new line here.
struct SidebarSection {
  Section section;
  const char* title;
  void (*draw)(ViewContext& view);
};
constexpr std::array kSidebar = {
    SidebarSection{Section::tuning, "Tuning", draw_tuning_panel},
    SidebarSection{Section::look, "Picture", draw_look_panel},
};

}  // namespace

void draw_sidebar(ViewContext& view) {
  for (const SidebarSection& s : kSidebar) {
    ImGui::PushID(s.title);
    ImGui::SetNextItemOpen(view.state.is_open(s.section));
    ImGui::PushFont(view.bold);
    const bool open = ImGui::CollapsingHeader(s.title);
    ImGui::PopFont();
    view.state.is_open(s.section) = open;
    if (open) {
      ImGui::Dummy({0, view.px(1)});
      s.draw(view);
      ImGui::Dummy({0, view.px(6)});
    }
    ImGui::PopID();
  }
}

}  // namespace saccade
