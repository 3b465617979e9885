#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/viewer/panels.hpp"
#include "ui/viewer/widgets.hpp"

namespace saccade {
namespace {

using Phase = SessionState::Phase;
using Connection = SourceState::Connection;

std::string short_name(const std::string& uri) {
  if (uri.find(':') != std::string::npos && !std::filesystem::exists(uri)) return uri;
  const auto path = std::filesystem::path(uri);
  return path.has_filename() ? path.filename().string() : uri;
}

// What is open and how it is doing, in plain words.
std::string source_line(const ViewContext& view) {
  const SessionState& s = view.source;
  if (s.phase == Phase::idle) return "Nothing is open";
  if (s.phase == Phase::opening) return "Opening…";
  if (s.phase == Phase::ended) return s.error.empty() ? "No more frames" : "Could not go on";
  if (s.source.live) {
    switch (s.connection.connection) {
      case Connection::waiting:
        return "Waiting for device";
      case Connection::lost:
        return "Lost, trying again";
      case Connection::streaming:
        if (view.playback.paused) return "Live, paused";
        return fmt::format("Live {:.1f} fps", view.history.rate_hz(StageHistory::Clock::now()));
    }
  }
  const std::string size = fmt::format("{} × {}", s.source.size.width, s.source.size.height);
  return s.source.frame_count ? fmt::format("{}, {} frames", size, *s.source.frame_count) : size;
}

unsigned state_colour(const ViewContext& view) {
  const SessionState& s = view.source;
  if (s.phase == Phase::ended && !s.error.empty()) return view.colours->error;
  if (s.connection.connection != Connection::streaming) return view.colours->warning;
  return view.colours->dim_text;
}

float width_of(const std::vector<std::string>& names, const ViewContext& view) {
  float width = 0;
  for (const std::string& name : names)
    width += ImGui::CalcTextSize(name.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x + view.px(1);
  return width;
}

}  // namespace

void draw_top_bar(ViewContext& view) {
  static const std::vector<std::string> centres = {"Picture", "Points", "Both"};
  static const std::vector<std::string> comparisons = {"A", "A | B", "Split"};
  if (ImGui::Button("Open…")) view.act(Action::open_source);
  tip(with_key("Open a recording, a folder or a sensor; or drop one onto the window", Action::open_source));
  note_place(view, "open");
  ImGui::SameLine(0, view.px(14));

  const float gap = view.px(14);
  const float theme_width = ImGui::CalcTextSize("Light").x + 2 * ImGui::GetStyle().FramePadding.x;
  const float help_width = ImGui::CalcTextSize("?").x + 2 * ImGui::GetStyle().FramePadding.x;
  const float right =
      width_of(centres, view) + width_of(comparisons, view) + theme_width + help_width + 4 * gap;
  const float name_right = ImGui::GetWindowWidth() - right - ImGui::GetStyle().WindowPadding.x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(corner, {ImGui::GetWindowPos().x + name_right, corner.y + ImGui::GetFrameHeight()},
                      true);
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(view.bold);
  ImGui::TextUnformatted(view.source.uri.empty() ? "Saccade" : short_name(view.source.uri).c_str());
  ImGui::PopFont();
  tip(view.source.uri);
  ImGui::SameLine(0, view.px(10));
  ImGui::PushStyleColor(ImGuiCol_Text, as_vec4(state_colour(view)));
  ImGui::TextUnformatted(source_line(view).c_str());
  ImGui::PopStyleColor();
  tip(view.source.connection.text);
  if (view.recording.phase == RecordingStatus::Phase::recording) {
    const auto s = static_cast<int>(view.recording.seconds);
    ImGui::SameLine(0, view.px(14));
    ImGui::TextColored(as_vec4(view.colours->error), "%s",
                       fmt::format("Recording {}:{:02}", s / 60, s % 60).c_str());
    tip(view.recording.file.string());
  }
  ImGui::PopClipRect();

  ImGui::SameLine(name_right + gap);
  int centre = static_cast<int>(view.state.centre);
  if (segments(view, "centre", centres, centre)) view.state.centre = static_cast<Centre>(centre);
  ImGui::SameLine(0, gap);
  int comparison = static_cast<int>(view.state.comparison);
  if (segments(view, "comparison", comparisons, comparison))
    view.state.comparison = static_cast<Comparison>(comparison);
  tip(with_key("Compare two models or kernels on the same frame", Action::next_comparison));
  ImGui::SameLine(0, gap);
  if (ImGui::Button(view.state.theme == Theme::dark ? "Light" : "Dark", {theme_width, 0}))
    view.act(Action::toggle_theme);
  tip(with_key("Dark or light", Action::toggle_theme));
  ImGui::SameLine(0, gap / 2);
  if (ImGui::Button("?")) view.act(Action::show_help);
  tip(with_key("Keyboard shortcuts", Action::show_help));
}

}  // namespace saccade
