#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {

void draw_help(ViewContext& view, bool& open) {
  constexpr const char* kTitle = "Keyboard shortcuts";
  if (open && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x * 0.96F, size.y * 0.94F});
  if (!ImGui::BeginPopupModal(kTitle, &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
    return;
  if (ImGui::BeginTable("groups", 2, ImGuiTableFlags_None)) {
    std::string_view group;
    const float left = ImGui::GetStyle().WindowPadding.x;  // SameLine() counts from the column
    const auto list = shortcuts();
    ImGui::TableNextColumn();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Shortcut& s = list[i];
      if (s.group != group) {
        if (!group.empty()) ImGui::Dummy({0, view.px(6)});
        if (s.group == "Picture") ImGui::TableNextColumn();
        group = s.group;
        ImGui::PushFont(view.fonts.bold);
        ImGui::TextUnformatted(group.data(), group.data() + group.size());
        ImGui::PopFont();
      }
      if (i > 0 && list[i - 1].action == s.action) continue;  // listed with its first key
      std::string keys = key_name(s);
      for (std::size_t k = i + 1; k < list.size() && list[k].action == s.action; ++k)
        keys += "  " + key_name(list[k]);
      ImGui::TextColored(as_vec4(view.colours->accent), "%s", keys.c_str());
      ImGui::SameLine(left + view.px(150));
      ImGui::TextUnformatted(s.text.data(), s.text.data() + s.text.size());
      ImGui::SameLine(left + view.px(400));
      ImGui::NewLine();
    }
    ImGui::EndTable();
  }
  ImGui::Separator();
  ImGui::TextDisabled("Mouse on the picture: wheel zooms, drag moves, double click fits it.");
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) open = false;
  if (!open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace saccade
