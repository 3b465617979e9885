// The layout of the window.
#include <algorithm>

#include <imgui.h>

#include "ui/panels/widgets.hpp"
#include "ui/window/viewer.hpp"

namespace saccade {

void Viewer::draw_window() {
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("##saccade", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const auto part = [&](const char* id, ImVec2 size, const auto& draw) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(view_.colours->panel));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view_.px(12), view_.px(8)});
    ImGui::BeginChild(id, size, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view_.px(8), view_.px(7)});
    draw();
    ImGui::PopStyleVar();
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
  };
  part("top", {0, ImGui::GetFrameHeight() + view_.px(16)}, [&] { draw_top_bar(view_); });
  ImGui::Dummy({0, view_.px(1)});
  const float widest = std::max(view_.px(260), ImGui::GetContentRegionAvail().x - view_.px(300));
  const float sidebar = state_.sidebar ? std::min(view_.px(state_.sidebar_width), widest) + view_.px(4) : 0;
  const float height = ImGui::GetContentRegionAvail().y;
  ImGui::BeginChild("body", {ImGui::GetContentRegionAvail().x - sidebar, height});
  draw_body(height);
  ImGui::EndChild();
  if (state_.sidebar) {
    ImGui::SameLine();
    draw_splitter(height);
    ImGui::SameLine();
    part("sidebar", {0, height}, [&] { sidebar_.draw(view_); });
  }
  ImGui::PopStyleVar(2);
  draw_notice(ImGui::GetIO().DisplaySize.x - sidebar);
  open_dialog_.draw(view_);
  settings_dialog_.draw(view_);
  help_.draw(view_);
  ImGui::End();
}

// Between picture and side bar, whose width a drag changes.
void Viewer::draw_splitter(float height) {
  ImGui::InvisibleButton("splitter", {view_.px(4), height});
  log_place(view_, "splitter");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (!ImGui::IsItemActive()) return;
  const auto moved = static_cast<double>(ImGui::GetIO().MouseDelta.x) / view_.unit;
  state_.sidebar_width = std::clamp(state_.sidebar_width - moved, kNarrowestSidebar, kWidestSidebar);
}

void Viewer::draw_body(float height) {
  const float timeline = view_.source.source.live ? 0 : ImGui::GetFontSize() + view_.px(34 + 7 + 4);
  const float transport = ImGui::GetFrameHeight() + view_.px(16) + timeline;
  const float before = ImGui::GetCursorPosY();
  draw_messages(view_);
  const float errors = ImGui::GetCursorPosY() - before;
  ImGui::BeginChild("centre", {0, std::max(1.0F, height - transport - errors - view_.px(1))}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  draw_centre();
  ImGui::EndChild();
  ImGui::Dummy({0, view_.px(1)});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(view_.colours->panel));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view_.px(12), view_.px(8)});
  ImGui::BeginChild("transport", {0, transport}, false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view_.px(8), view_.px(7)});
  draw_transport(view_);
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

void Viewer::draw_centre() {
  const bool both = state_.centre == Centre::both;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  if (state_.centre == Centre::cloud) {
    view_.pointer.reset();
    view_.hovered_mark = -1;
  }
  if (state_.centre != Centre::cloud) {
    ImGui::BeginChild("picture", {both ? room.x / 2 - view_.px(1) : 0, 0}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    picture_.draw(view_);
    ImGui::EndChild();
  }
  view_.over_picture = nullptr;  // the side bar, drawn later, sets it again
  if (both) ImGui::SameLine(0, view_.px(2));
  if (state_.centre != Centre::picture) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view_.px(8), view_.px(7)});
    ImGui::BeginChild("cloud", {0, 0}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    cloud_.draw(view_);
    ImGui::EndChild();
    ImGui::PopStyleVar();
  }
  view_.centre_on.reset();
  draw_state_banner(view_, corner, {corner.x + room.x, corner.y + room.y});
  draw_welcome(view_, corner, {corner.x + room.x, corner.y + room.y});
}

// At the bottom of a body of this width, above the transport, in as many lines as it needs; errors are at the
// top.
void Viewer::draw_notice(float body) {
  if (view_.notice.empty()) return;
  if (ImGui::GetTime() > view_.notice_until) {
    view_.notice.clear();
    return;
  }
  const ImVec2 pad{view_.px(14), view_.px(8)};
  const float wrap = 0.9F * body - 2 * pad.x;
  const char* text = view_.notice.c_str();
  const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, wrap);
  const ImVec2 corner{(body - size.x) / 2 - pad.x,
                      ImGui::GetIO().DisplaySize.y - view_.px(140) - size.y - 2 * pad.y};
  const ImVec2 end{corner.x + size.x + 2 * pad.x, corner.y + size.y + 2 * pad.y};
  view_.places["notice"] = {corner.x, corner.y, end.x, end.y};
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  draw.AddRectFilled(corner, end, IM_COL32(20, 24, 29, 235), view_.px(8));
  draw.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {corner.x + pad.x, corner.y + pad.y},
               IM_COL32(235, 238, 242, 255), text, nullptr, wrap);
}

}  // namespace saccade
