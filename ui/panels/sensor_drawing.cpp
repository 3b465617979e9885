#include "ui/panels/sensor_drawing.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "core/file.hpp"
#include "core/text.hpp"

namespace saccade {
namespace {

std::string seconds_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

void draw_headline(const SensorFacts& facts, std::chrono::steady_clock::time_point now, ImFont* large) {
  const Headline line = headline(facts.source, now);
  ImGui::PushFont(large);
  wrapped_text(line.text, line.tone);
  ImGui::PopFont();
  if (!facts.source.uri.empty()) wrapped_text(facts.source.uri, Tone::quiet);
  const SourceState& connection = facts.source.connection;
  if (!facts.source.error.empty())
    wrapped_text(facts.source.error, Tone::bad);
  else if (!connection.text.empty())
    wrapped_text(connection.text, Tone::quiet);
  for (const std::string& note : connection.notes) wrapped_text(note, Tone::warning);
  if (connection.colourless > 0)
    wrapped_text(counted(connection.colourless, "frame") + " without colour so far", Tone::warning);
  if (connection.losses > 0)
    wrapped_text(fmt::format("{} so far, {} in total", counted(connection.losses, "dropout"),
                             seconds_text(connection.away_s)),
                 Tone::warning);
}

void draw_sensor_buttons(const SensorFacts& facts, SensorActions& actions) {
  const bool recording = facts.recording.phase == RecordingStatus::Phase::recording;
  ImGui::BeginDisabled(facts.recording.phase == RecordingStatus::Phase::closing ||
                       (!recording && !facts.source.open));
  if (recording) ImGui::PushStyleColor(ImGuiCol_Button, {0.70F, 0.10F, 0.10F, 1});
  if (recording) ImGui::PushStyleColor(ImGuiCol_Text, {1, 1, 1, 1});
  // One width for both labels, so that the buttons do not move.
  const float width = ImGui::CalcTextSize("Stop recording").x + 2 * ImGui::GetStyle().FramePadding.x;
  actions.toggle_recording =
      ImGui::Button(recording ? "Stop recording###record" : "Record###record", {width, 0});
  if (recording) ImGui::PopStyleColor(2);
  ImGui::EndDisabled();
  explain("Records every frame of the source to an .oni file, also frames that are not computed.");
  ImGui::SameLine();
  ImGui::BeginDisabled(!facts.source.open);
  actions.snapshot = ImGui::Button("Snapshot");
  ImGui::EndDisabled();
  explain(
      "Writes the frame on screen: depth and colour (PNG), point cloud (PLY), overlay (PNG), saliency map "
      "(TIFF, PNG), fixations (JSON) and settings (TOML).");
}

void draw_written(const SensorFacts& facts) {
  if (!facts.folder.empty())
    wrapped_text(
        "Files go to " + facts.folder +
            (facts.free_bytes ? fmt::format(", {} free", megabytes(static_cast<double>(*facts.free_bytes)))
                              : ""),
        Tone::quiet);
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
  if (ImGui::SmallButton(open ? "In use" : "Open")) actions.open = device.source;
  ImGui::EndDisabled();
  explain(device.source);
  ImGui::SameLine();
  wrapped_text(device.detail.empty() ? device.name : fmt::format("{} ({})", device.name, device.detail));
  ImGui::PopID();
}

void draw_devices(const SensorFacts& facts, SensorActions& actions) {
  wrapped_text("Sensors", Tone::quiet);
  if (!facts.devices_error.empty()) return wrapped_text(facts.devices_error, Tone::bad);
  if (!facts.devices) return wrapped_text("Looking for sensors …", Tone::quiet);
  const bool streams = facts.source.open && facts.source.live &&
                       facts.source.connection.connection == SourceState::Connection::streaming;
  if (facts.devices->empty() && streams) return wrapped_text("In use: " + facts.source.connection.text);
  if (facts.devices->empty())
    wrapped_text(
        "No sensor is connected. A new one appears here by itself; if one is missing, run: saccade doctor",
        Tone::quiet);
  for (const DeviceChoice& device : *facts.devices)
    draw_device(device,
                facts.source.open && (facts.source.uri == device.source ||
                                      (facts.source.uri == "openni2" && facts.devices->size() == 1)),
                actions);
}

void draw_mode(const SensorFacts& facts, SensorActions& actions) {
  if (facts.modes.empty()) return;
  named_row("Mode", "Size and rate of the depth images. A change opens the sensor again.", [&] {
    const bool open = ImGui::BeginCombo("##mode", to_text(facts.mode).c_str());
    if (!open) actions.places.push_back(place_of_item("Mode"));
    if (!open) return false;
    for (const SensorMode& mode : facts.modes) {
      if (ImGui::Selectable(to_text(mode).c_str(), mode == facts.mode) && mode != facts.mode)
        actions.mode = mode;
      actions.places.push_back(place_of_item(to_text(mode)));
    }
    ImGui::EndCombo();
    return true;
  });
}

// A switch of the sensor, if it has that one. A change goes into `request`.
void draw_switch(const char* label, const std::optional<bool>& value, const char* what,
                 std::optional<bool> SensorValues::*field, SensorActions& actions) {
  if (!value) return;
  bool on = *value;
  if (ImGui::Checkbox(label, &on)) {
    if (!actions.request) actions.request.emplace();
    (*actions.request).*field = on;
  }
  actions.places.push_back(place_of_item(label));
  explain(what);
}

void draw_exposure(const SensorValues& values, SensorActions& actions) {
  draw_switch("Automatic exposure", values.auto_exposure, "The colour camera sets its exposure itself.",
              &SensorValues::auto_exposure, actions);
  if (!values.exposure || values.auto_exposure.value_or(false)) return;
  int exposure = *values.exposure;
  if (!named_row("Exposure", "In the sensor's own unit; larger is brighter. Press Enter to set it.", [&] {
        return ImGui::InputInt("##exposure", &exposure, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
      }))
    return;
  if (!actions.request) actions.request.emplace();
  actions.request->exposure = std::max(exposure, 0);
}

void draw_controls(const SensorFacts& facts, SensorActions& actions) {
  const SensorValues& values = facts.values;
  draw_switch("Registration", values.registration, "Aligns the depth with the colour image.",
              &SensorValues::registration, actions);
  draw_switch("Mirror", values.mirror, "Swaps left and right.", &SensorValues::mirror, actions);
  draw_exposure(values, actions);
  draw_switch("Automatic white balance", values.auto_white_balance,
              "The colour camera sets its white balance itself.", &SensorValues::auto_white_balance, actions);
}

}  // namespace

Headline headline(const SourceFacts& source, std::chrono::steady_clock::time_point now) {
  using Connection = SourceState::Connection;
  if (source.opening) return {"Opening …", Tone::quiet};
  if (!source.error.empty()) return {"Stopped by an error", Tone::bad};
  if (!source.open) return {source.uri.empty() ? "No source" : "No more frames", Tone::quiet};
  switch (source.connection.connection) {
    case Connection::waiting:
      return {"Waiting for the sensor", Tone::warning};
    case Connection::lost: {
      const double s = std::chrono::duration<double>(now - source.connection.since).count();
      return {fmt::format("Sensor lost {} ago, retrying", seconds_text(std::max(s, 0.0))), Tone::bad};
    }
    case Connection::streaming:
      break;
  }
  if (source.paused) return {source.live ? "Live, paused" : "Paused", Tone::plain};
  if (source.rate_hz > 0)
    return {fmt::format("{} {:.1f} fps", source.live ? "Live" : "Playing", source.rate_hz),
            source.live ? Tone::good : Tone::plain};
  return source.live ? Headline{"Live, no frames", Tone::warning} : Headline{"Playing", Tone::plain};
}

Headline recording_line(const RecordingStatus& recording) {
  if (recording.file.empty()) return {};
  const char* what = recording.phase == RecordingStatus::Phase::recording ? "Recording"
                     : recording.phase == RecordingStatus::Phase::closing ? "Closing the file"
                     : recording.error.empty()                            ? "Recorded"
                                                                          : "Ended early";
  std::string text =
      fmt::format("{}: {}, {}, {}", what, seconds_text(recording.seconds), counted(recording.frames, "frame"),
                  megabytes(static_cast<double>(recording.bytes)));
  text += fmt::format(", {} dropped", recording.dropped);
  const bool trouble = recording.dropped > 0 || !recording.error.empty();
  return {text, trouble                                                ? Tone::warning
                : recording.phase == RecordingStatus::Phase::recording ? Tone::good
                                                                       : Tone::plain};
}

SensorActions draw_sensors(const SensorFacts& facts, std::chrono::steady_clock::time_point now,
                           ImFont* large) {
  SensorActions actions;
  draw_headline(facts, now, large);
  ImGui::Spacing();
  draw_sensor_buttons(facts, actions);
  draw_written(facts);
  ImGui::Spacing();
  draw_devices(facts, actions);
  draw_mode(facts, actions);
  draw_controls(facts, actions);
  return actions;
}

}  // namespace saccade
