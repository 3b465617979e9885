#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "core/text.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

using Phase = SessionState::Phase;

// The state of the open source.
std::string source_line(const ViewContext& view) {
  const SessionState& s = view.source;
  const auto now = StageHistory::Clock::now();
  if (!s.opening.empty()) return "Opening " + short_name(s.opening) + " …";
  if (s.phase == Phase::ended && s.error.empty()) return "No more frames";
  if (s.phase != Phase::open || s.source.live) {
    std::string line = headline(source_facts(view), now).text;
    if (s.phase == Phase::open && view.captured_hz > 0 && !view.playback.paused &&
        s.connection.connection == SourceState::Connection::streaming)
      line += fmt::format(", {:.1f} computed", view.history.rate_hz(now));
    return line;
  }
  const std::string size = fmt::format("{} × {}", s.source.size.width, s.source.size.height);
  return s.source.frame_count ? fmt::format("{}, {}", size, counted(*s.source.frame_count, "frame")) : size;
}

ImVec4 state_colour(const ViewContext& view) {
  const SessionState& s = view.source;
  if (s.phase == Phase::open && !s.source.live) return tone_colour(Tone::quiet);
  return tone_colour(headline(source_facts(view), StageHistory::Clock::now()).tone);
}

float width_of(const std::vector<std::string>& names, const ViewContext& view) {
  float width = 0;
  for (const std::string& name : names)
    width += ImGui::CalcTextSize(name.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x + view.px(1);
  return width;
}

// The name of the source, its state, and the running recording, up to `right`; a long name leaves room for
// the rest, and the state is left out where little of the name would be seen.
void draw_source(ViewContext& view, float right) {
  const std::string name = view.source.uri.empty() ? "Saccade" : short_name(view.source.uri);
  const std::string state = source_line(view);
  const auto s = static_cast<int>(view.recording.seconds);
  const bool records = view.recording.phase == RecordingStatus::Phase::recording;
  const std::string recording = records ? fmt::format("Recording {}:{:02}", s / 60, s % 60) : "";
  const float gap = view.px(10);
  const auto room = [&] { return right - ImGui::GetCursorScreenPos().x; };
  float rest = ImGui::CalcTextSize(state.c_str()).x + gap;
  if (records) rest += ImGui::CalcTextSize(recording.c_str()).x + gap;
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(view.fonts.bold);
  const float name_room = std::max(room() - rest, room() / 3);
  const bool name_only = name_room < std::min(ImGui::CalcTextSize(name.c_str()).x, view.px(60));
  clipped_text(name, name_only ? room() : name_room);
  ImGui::PopFont();
  log_place(view, "source");
  explain(name_only ? view.source.uri + "\n" + state : view.source.uri);
  if (name_only) return;
  ImGui::SameLine(0, gap);
  ImGui::PushStyleColor(ImGuiCol_Text, state_colour(view));
  clipped_text(state, room());
  ImGui::PopStyleColor();
  log_place(view, "state");
  explain(view.source.connection.text);
  if (!records) return;
  ImGui::SameLine(0, gap);
  ImGui::PushStyleColor(ImGuiCol_Text, view.colours->error);
  clipped_text(recording, room());
  ImGui::PopStyleColor();
  explain(view.recording.file.string());
}

}  // namespace

void draw_top_bar(ViewContext& view) {
  static const std::vector<std::string> centres = {"Picture", "Points", "Both"};
  static const std::vector<std::string> comparisons = {"A", "A | B", "Split", "A − B"};
  if (ImGui::Button("Open…")) view.act(Action::open_source);
  explain(with_key("Open a recording, a folder or a sensor; or drop a file onto the window",
                   Action::open_source));
  log_place(view, "open");
  ImGui::SameLine(0, view.px(14));

  const float gap = view.px(14);
  const float theme_width = ImGui::CalcTextSize("Light").x + 2 * ImGui::GetStyle().FramePadding.x;
  const float help_width = ImGui::CalcTextSize("?").x + 2 * ImGui::GetStyle().FramePadding.x;
  const float right =
      width_of(centres, view) + width_of(comparisons, view) + theme_width + help_width + 4 * gap;
  const float name_right = ImGui::GetWindowWidth() - right - ImGui::GetStyle().WindowPadding.x;
  draw_source(view, ImGui::GetWindowPos().x + name_right);

  ImGui::SameLine(name_right + gap);
  int centre = static_cast<int>(view.state.centre);
  if (segments(view, "centre", centres, centre)) view.state.centre = static_cast<Centre>(centre);
  explain(with_key("The picture, the point cloud, or both", Action::next_centre));
  ImGui::SameLine(0, gap);
  int comparison = static_cast<int>(view.state.comparison);
  if (segments(view, "comparison", comparisons, comparison))
    view.state.comparison = static_cast<Comparison>(comparison);
  explain(
      with_key("Compare two settings on the same frame: side by side, with a divider, or their difference",
               Action::next_comparison));
  ImGui::SameLine(0, gap);
  if (ImGui::Button(view.state.theme == Theme::dark ? "Light" : "Dark", {theme_width, 0}))
    view.act(Action::toggle_theme);
  explain(with_key("Switch to the other theme", Action::toggle_theme));
  ImGui::SameLine(0, gap / 2);
  if (ImGui::Button("?")) view.act(Action::show_help);
  explain(with_key("Help: keys, mouse, what the colours mean, and a glossary", Action::show_help));
}

}  // namespace saccade
