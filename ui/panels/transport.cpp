#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

std::string speed_name(double speed) { return speed > 0 ? fmt::format("{:g}×", speed) : "every frame"; }

void draw_speed(ViewContext& view) {
  ImGui::SetNextItemWidth(ImGui::CalcTextSize("every frame").x + 1.6F * ImGui::GetFrameHeight());
  if (ImGui::BeginCombo("##speed", speed_name(view.playback.speed).c_str())) {
    for (const double speed : play_speeds())
      if (ImGui::Selectable(speed_name(speed).c_str(), speed == view.playback.speed))
        view.session.playback().set_speed(speed);
    ImGui::EndCombo();
  }
  explain(fmt::format(
      "Speed of playing, relative to the recorded times; frames for which there is no time are "
      "dropped. \"every frame\" computes all of them, as fast as it can. Keys: {} is slower, {} is faster",
      key_name(Action::slower), key_name(Action::faster)));
}

// A button for an action, after a space of `gap`.
void action_button(ViewContext& view, const char* name, Icon icon, Action action, const std::string& text,
                   float gap, bool lit = false) {
  if (gap > 0) ImGui::SameLine(0, gap);
  ImGui::PushID(name);
  if (icon_button(view, "##button", icon, lit, with_key(text, action))) view.act(action);
  ImGui::PopID();
  log_place(view, name);
}

void draw_recording_buttons(ViewContext& view) {
  const bool recording = view.recording.phase == RecordingStatus::Phase::recording;
  action_button(view, "record", Icon::record, Action::record,
                recording ? "Stop recording" : "Record to an .oni file", view.px(10), recording);
  action_button(view, "snapshot", Icon::camera, Action::snapshot,
                "Snapshot of this frame: depth, colour, points, map, overlay and fixations", view.px(3));
}

void draw_transport_buttons(ViewContext& view) {
  const bool paused = view.playback.paused, live = view.source.source.live, loop = view.playback.loop;
  const float gap = view.px(3);
  if (!live) {
    action_button(view, "first", Icon::first, Action::first_frame, "First frame", 0);
    action_button(view, "back", Icon::step_back, Action::previous_frame, "Previous frame", gap);
  }
  action_button(view, "play", paused ? Icon::play : Icon::pause, Action::play_pause,
                paused ? "Play" : "Pause", live ? 0 : gap);
  if (live) return draw_recording_buttons(view);
  action_button(view, "on", Icon::step_forward, Action::next_frame, "Next frame", gap);
  action_button(view, "last", Icon::last, Action::last_frame, "Last frame", gap);
  action_button(view, "loop", Icon::loop, Action::toggle_loop, loop ? "Stop looping" : "Loop", view.px(10),
                loop);
  draw_recording_buttons(view);
  ImGui::SameLine(0, view.px(10));
  draw_speed(view);
}

// With the number of dropped frames, if there is room for it.
std::string position_text(const ViewContext& view, float room) {
  if (!view.result) return "";
  const Frame& frame = view.result->frame();
  const auto count = view.source.source.frame_count;
  const std::string of = count ? fmt::format(" of 0..{}", *count - 1) : "";
  const std::string text =
      fmt::format("frame {}{}   {:.2f} s", frame.index, of, static_cast<double>(frame.timestamp_us) / 1e6);
  const std::int64_t dropped = view.source.ledger.dropped;
  const std::string more = dropped > 0 ? fmt::format("{}   {} dropped", text, dropped) : text;
  return ImGui::CalcTextSize(more.c_str()).x <= room ? more : text;
}

void draw_contents(ViewContext& view) {
  draw_transport_buttons(view);
  ImGui::SameLine(0, view.px(16));
  const std::string text = position_text(view, ImGui::GetContentRegionAvail().x);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  explain(
      "The frame on screen, its time, and how many frames were dropped since there was no time to compute "
      "them");
  if (view.source.source.live) return;
  const auto seen = static_cast<std::int64_t>(view.timeline.entries().size());
  const std::int64_t frames = view.source.source.frame_count.value_or(seen);
  const char* caption = "largest saliency";
  const float width = ImGui::CalcTextSize(caption).x;
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x > width + view.px(10)) {
    ImGui::SameLine(ImGui::GetWindowWidth() - width - ImGui::GetStyle().WindowPadding.x);
    ImGui::TextDisabled("%s", caption);
  } else {
    ImGui::NewLine();
  }
  if (frames > 0) draw_timeline(view, frames);
}

}  // namespace

// Nothing can be pressed while nothing is open.
void draw_transport(ViewContext& view) {
  ImGui::BeginDisabled(view.source.phase != SessionState::Phase::open);
  draw_contents(view);
  ImGui::EndDisabled();
}

}  // namespace saccade
