#include "ui/sensor_panel.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "core/file.hpp"

namespace saccade {
namespace {

using Phase = RecordingStatus::Phase;

std::string seconds_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

void draw_headline(const SensorFacts& facts, std::chrono::steady_clock::time_point now) {
  const Headline line = headline(facts.source, now);
  ImGui::SetWindowFontScale(1.5F);
  wrapped_text(line.text, line.tone);
  ImGui::SetWindowFontScale(1);
  if (!facts.source.uri.empty()) wrapped_text(facts.source.uri, Tone::quiet);
  const SourceState& connection = facts.source.connection;
  if (!facts.source.error.empty())
    wrapped_text(facts.source.error, Tone::bad);
  else if (!connection.text.empty())
    wrapped_text(connection.text, Tone::quiet);
  if (connection.losses > 0)
    wrapped_text(fmt::format("lost {} so far, away for {}",
                             connection.losses == 1 ? "once" : fmt::format("{} times", connection.losses),
                             seconds_text(connection.away_s)),
                 Tone::warning);
}

void draw_buttons(const SensorFacts& facts, SensorActions& actions) {
  const bool recording = facts.recording.phase == Phase::recording;
  ImGui::BeginDisabled(facts.recording.phase == Phase::closing || (!recording && !facts.source.open));
  if (recording) ImGui::PushStyleColor(ImGuiCol_Button, {0.70F, 0.10F, 0.10F, 1});
  if (recording) ImGui::PushStyleColor(ImGuiCol_Text, {1, 1, 1, 1});
  // One width for both words, so that the buttons stay where they are.
  const float width = ImGui::CalcTextSize("stop recording").x + 2 * ImGui::GetStyle().FramePadding.x;
  actions.toggle_recording =
      ImGui::Button(recording ? "stop recording###record" : "record###record", {width, 0});
  if (recording) ImGui::PopStyleColor(2);
  ImGui::EndDisabled();
  explain(
      "Records every frame that comes from the source, also those that are not computed, to an .oni file.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!facts.source.open);
  actions.snapshot = ImGui::Button("snapshot");
  ImGui::EndDisabled();
  explain("Writes what is on screen: overlay (PNG), saliency map (TIFF) and fixations (JSON).");
}

void draw_written(const SensorFacts& facts) {
  if (!facts.folder.empty()) wrapped_text("Files go to " + facts.folder, Tone::quiet);
  const Headline line = recording_line(facts.recording);
  if (!line.text.empty()) wrapped_text(line.text, line.tone);
  if (!facts.recording.file.empty()) wrapped_text(facts.recording.file.string(), Tone::quiet);
  if (!facts.recording.error.empty()) wrapped_text(facts.recording.error, Tone::bad);
  if (!facts.snapshot.empty()) wrapped_text(facts.snapshot, Tone::quiet);
  if (!facts.snapshot_error.empty()) wrapped_text(facts.snapshot_error, Tone::bad);
}

void draw_device(const DeviceChoice& device, bool open, SensorActions& actions) {
  ImGui::PushID(device.source.c_str());
  ImGui::BeginDisabled(open);
  if (ImGui::SmallButton(open ? "in use" : "open")) actions.open = device.source;
  ImGui::EndDisabled();
  explain(device.source.c_str());
  ImGui::SameLine();
  wrapped_text(device.detail.empty() ? device.name : fmt::format("{} ({})", device.name, device.detail));
  ImGui::PopID();
}

void draw_devices(const SensorFacts& facts, SensorActions& actions) {
  wrapped_text("Sensors", Tone::quiet);
  if (!facts.devices_error.empty()) return wrapped_text(facts.devices_error, Tone::bad);
  if (!facts.devices) return wrapped_text("looking for sensors ...", Tone::quiet);
  if (facts.devices->empty())
    wrapped_text("none is connected; a new one appears here by itself. If one should be here: saccade doctor",
                 Tone::quiet);
  for (const DeviceChoice& device : *facts.devices)
    draw_device(device,
                facts.source.open && (facts.source.uri == device.source ||
                                      (facts.source.uri == "openni2" && facts.devices->size() == 1)),
                actions);
}

void draw_mode(const SensorFacts& facts, SensorActions& actions) {
  if (facts.modes.empty()) return;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
  if (ImGui::BeginCombo("mode", facts.mode.c_str())) {
    for (const std::string& mode : facts.modes)
      if (ImGui::Selectable(mode.c_str(), mode == facts.mode) && mode != facts.mode) actions.mode = mode;
    ImGui::EndCombo();
  }
  explain("Size and rate of the depth; a change opens the sensor again.");
}

// A switch of the sensor, if it has that one. What is asked for goes into `request`.
void draw_switch(const char* label, const std::optional<bool>& value, const char* what,
                 std::optional<bool> SensorValues::*field, SensorActions& actions) {
  if (!value) return;
  bool on = *value;
  if (ImGui::Checkbox(label, &on)) {
    if (!actions.request) actions.request.emplace();
    (*actions.request).*field = on;
  }
  explain(what);
}

void draw_controls(const SensorFacts& facts, SensorActions& actions) {
  const SensorValues& values = facts.values;
  draw_switch("registration", values.registration, "Depth as seen from the colour camera.",
              &SensorValues::registration, actions);
  draw_switch("mirror", values.mirror, "Left and right exchanged.", &SensorValues::mirror, actions);
  draw_switch("automatic exposure", values.auto_exposure, "The colour camera sets its exposure itself.",
              &SensorValues::auto_exposure, actions);
  if (values.exposure && !values.auto_exposure.value_or(false)) {
    int exposure = *values.exposure;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 10);
    if (ImGui::InputInt("exposure", &exposure, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue)) {
      if (!actions.request) actions.request.emplace();
      actions.request->exposure = std::max(exposure, 0);
    }
    explain("In the sensor's own unit; larger is brighter.");
  }
  draw_switch("automatic white balance", values.auto_white_balance,
              "The colour camera sets its white balance itself.", &SensorValues::auto_white_balance, actions);
}

}  // namespace

Headline headline(const SourceFacts& source, std::chrono::steady_clock::time_point now) {
  using Connection = SourceState::Connection;
  if (!source.error.empty()) return {"stopped by an error", Tone::bad};
  if (!source.open) return {source.uri.empty() ? "no source" : "opening ...", Tone::quiet};
  switch (source.connection.connection) {
    case Connection::waiting:
      return {"waiting for device", Tone::warning};
    case Connection::lost: {
      const double s = std::chrono::duration<double>(now - source.connection.since).count();
      return {fmt::format("lost {} ago, retrying", seconds_text(std::max(s, 0.0))), Tone::bad};
    }
    case Connection::streaming:
      break;
  }
  if (source.paused) return {source.live ? "live, paused" : "paused", Tone::plain};
  if (source.rate_hz > 0)
    return {fmt::format("{} {:.1f} fps", source.live ? "live" : "playing", source.rate_hz),
            source.live ? Tone::good : Tone::plain};
  return source.live ? Headline{"live, no frames", Tone::warning} : Headline{"playing", Tone::plain};
}

Headline recording_line(const RecordingStatus& recording) {
  if (recording.file.empty()) return {};
  const char* what = recording.phase == Phase::recording ? "recording"
                     : recording.phase == Phase::closing ? "closing the file"
                     : recording.error.empty()           ? "recorded"
                                                         : "ended early";
  std::string text = fmt::format("{}: {}, {} frames, {}", what, seconds_text(recording.seconds),
                                 recording.frames, megabytes(static_cast<double>(recording.bytes)));
  if (recording.free_bytes)
    text += fmt::format(" ({} free)", megabytes(static_cast<double>(*recording.free_bytes)));
  text += fmt::format(", {} dropped", recording.dropped);
  const bool trouble = recording.dropped > 0 || !recording.error.empty();
  return {text, trouble ? Tone::warning : recording.phase == Phase::recording ? Tone::good : Tone::plain};
}

SensorActions draw_sensor_panel(const SensorFacts& facts, std::chrono::steady_clock::time_point now) {
  SensorActions actions;
  draw_headline(facts, now);
  ImGui::Spacing();
  draw_buttons(facts, actions);
  draw_written(facts);
  ImGui::Spacing();
  draw_devices(facts, actions);
  draw_mode(facts, actions);
  draw_controls(facts, actions);
  return actions;
}

}  // namespace saccade
