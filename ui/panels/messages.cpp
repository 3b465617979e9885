#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {

namespace {

constexpr std::size_t kLongestMessage = 400;  // bytes: what of it has room in a small window

}  // namespace

void ViewContext::notify(const std::string& line) {
  constexpr double kNoticeTime_s = 4;
  notice = shortened(line, kLongestMessage);
  notice_until = ImGui::GetTime() + kNoticeTime_s;
}

void ViewContext::report(const std::string& error) {
  std::string text = shortened(error, kLongestMessage);
  if (errors.empty() || errors.back() != text) errors.push_back(std::move(text));
}

std::optional<cv::Point3d> ViewContext::point_at(std::optional<cv::Point> pixel) const {
  if (!result || !pixel || !cv::Rect({}, result->frame().size()).contains(*pixel)) return std::nullopt;
  const auto z = static_cast<double>(result->frame().depth_mm(*pixel));
  if (!(z > 0)) return std::nullopt;
  return result->frame().intrinsics.point_mm(pixel->y, pixel->x, z);
}

namespace {

struct Bar {
  const char* id;
  const char* dismiss;  // the name of its button in the log
  unsigned back, colour;
};

struct BarButton {
  std::string label;
  const char* place;  // in the log
  std::string explanation;
  std::function<void()> press;
};

float width_of(const std::string& label) {
  return ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
}

// A wrapped text with buttons at its right. Returns whether the user dismissed it.
bool draw_bar(ViewContext& view, const Bar& bar, const std::string& text,
              const std::vector<BarButton>& buttons) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  float right = width_of("×");
  for (const BarButton& button : buttons) right += width_of(button.label) + gap;
  const float wrap = std::max(view.px(80), ImGui::GetContentRegionAvail().x - right - view.px(36));
  const float lines = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap - view.px(12)).y;
  const float height = std::max(lines, ImGui::GetFrameHeight()) + 2 * view.px(8);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(bar.back));
  ImGui::BeginChild(bar.id, {0, height}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PushTextWrapPos(wrap);
  ImGui::PushStyleColor(ImGuiCol_Text, as_vec4(bar.colour));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos({ImGui::GetWindowWidth() - view.px(12) - right, view.px(8)});
  for (const BarButton& button : buttons) {
    if (ImGui::Button(button.label.c_str())) button.press();
    log_place(view, button.place);
    explain(button.explanation);
    ImGui::SameLine(0, gap);
  }
  const bool dismissed = ImGui::Button("×");
  log_place(view, bar.dismiss);
  explain("Dismiss");
  ImGui::EndChild();
  ImGui::PopStyleColor();
  return dismissed;
}

void draw_notes(ViewContext& view) {
  if (view.notes.empty()) return;
  std::string text;
  for (const std::string& note : view.notes) text += (text.empty() ? "" : "\n") + note;
  const Bar bar{"notes", "dismiss notes", view.colours->panel, view.colours->warning};
  if (draw_bar(view, bar, text, {})) view.notes.clear();
}

void draw_connected(ViewContext& view) {
  if (view.connected.empty()) return;
  const DeviceChoice device = view.connected.back();
  const Bar bar{"connected", "dismiss connected", view.colours->panel, view.colours->text};
  const bool dismissed =
      draw_bar(view, bar, device.name + " was connected.",
               {{"Open it", "open connected", "Opens " + device.source, [&] { view.open(device.source); }}});
  if (dismissed) view.connected.pop_back();
}

void draw_recorded(ViewContext& view) {
  if (view.recorded.empty()) return;
  const Bar bar{"recorded", "dismiss recorded", view.colours->panel, view.colours->text};
  const std::string file = view.recorded;
  const bool dismissed =
      draw_bar(view, bar, "Recorded " + file,
               {{"Play it", "play recorded", "Opens the recording in place of the present source",
                 [&] { view.open(file); }}});
  if (dismissed) view.recorded.clear();
}

// Each error stays until the user dismisses it; the rest of the window goes on working, so only the newest
// have room.
void draw_errors(ViewContext& view) {
  std::vector<BarButton> buttons;
  if (view.source.phase == SessionState::Phase::ended)
    buttons.push_back({"Try again", "try again",
                       "Opens " + shortened(view.source.uri, kLongestMessage) + " again",
                       [&] { view.open(view.source.uri); }});
  if (view.source.phase != SessionState::Phase::open)
    buttons.push_back(
        {"Open another…", "open another", "Chooses another source", [&] { view.act(Action::open_source); }});
  const Bar bar{"error", "dismiss error", view.colours->error_back, view.colours->error};
  constexpr int kMostBars = 3;
  const auto errors = static_cast<int>(view.errors.size());
  bool all_gone = false;
  if (errors > kMostBars)
    buttons.push_back({fmt::format("Dismiss all {}", errors), "dismiss all errors",
                       "Also those that are not shown", [&] { all_gone = true; }});
  int gone = -1;
  for (int i = std::max(0, errors - kMostBars); i < errors; ++i) {
    ImGui::PushID(i);
    if (draw_bar(view, bar, view.errors[static_cast<std::size_t>(i)], buttons)) gone = i;
    ImGui::PopID();
  }
  if (gone >= 0) view.errors.erase(view.errors.begin() + gone);
  if (all_gone) view.errors.clear();
}

}  // namespace

void draw_messages(ViewContext& view) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view.px(12), view.px(8)});
  draw_notes(view);
  draw_connected(view);
  draw_recorded(view);
  draw_errors(view);
  ImGui::PopStyleVar();
}

}  // namespace saccade
