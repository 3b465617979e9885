#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {

void ViewContext::notify(std::string line) {
  constexpr double kNoticeTime_s = 3;
  notice = std::move(line);
  notice_until = ImGui::GetTime() + kNoticeTime_s;
}

namespace {

void draw_notes(ViewContext& view) {
  if (view.notes.empty()) return;
  std::string text;
  for (const std::string& note : view.notes) text += (text.empty() ? "" : "\n") + note;
  const float wrap = ImGui::GetContentRegionAvail().x - view.px(60);
  const float lines = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap - view.px(12)).y;
  const float height = std::max(lines, ImGui::GetFrameHeight()) + 2 * view.px(8);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(view.colours->panel));
  ImGui::BeginChild("notes", {0, height}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PushTextWrapPos(wrap);
  ImGui::PushStyleColor(ImGuiCol_Text, as_vec4(view.colours->warning));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos({ImGui::GetWindowWidth() - view.px(12) - ImGui::GetFrameHeight(), view.px(8)});
  if (ImGui::Button("×##notes")) view.notes.clear();
  log_place(view, "dismiss notes");
  explain("Dismiss");
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

}  // namespace

// Each error stays until the user dismisses it; the rest of the window goes on working.
void draw_messages(ViewContext& view) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view.px(12), view.px(8)});
  draw_notes(view);
  int gone = -1;
  for (int i = 0; i < static_cast<int>(view.errors.size()); ++i) {
    const std::string& line = view.errors[static_cast<std::size_t>(i)];
    ImGui::PushID(i);
    const float wrap = ImGui::GetContentRegionAvail().x - view.px(190);
    const float text = ImGui::CalcTextSize(line.c_str(), nullptr, false, wrap).y;
    const float height = std::max(text, ImGui::GetFrameHeight()) + 2 * view.px(8);
    ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(view.colours->error_back));
    ImGui::BeginChild("error", {0, height}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PushTextWrapPos(wrap);
    ImGui::PushStyleColor(ImGuiCol_Text, as_vec4(view.colours->error));
    ImGui::TextWrapped("%s", line.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPos({ImGui::GetWindowWidth() - view.px(172), view.px(8)});
    if (view.source.phase == SessionState::Phase::ended) {
      if (ImGui::Button("Open another…")) view.act(Action::open_source);
      ImGui::SameLine();
    } else {
      ImGui::SetCursorPosX(ImGui::GetWindowWidth() - view.px(12) - ImGui::GetFrameHeight());
    }
    if (ImGui::Button("×")) gone = i;
    log_place(view, "dismiss error");
    explain("Dismiss");
    ImGui::EndChild();
    ImGui::PopStyleColor();
    ImGui::PopID();
  }
  ImGui::PopStyleVar();
  if (gone >= 0) view.errors.erase(view.errors.begin() + gone);
}

}  // namespace saccade
