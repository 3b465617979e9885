#include "ui/panels/sensor_panel.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"
#include "ui/session/sensor_settings_sync.hpp"
#include "ui/session/snapshot.hpp"
#include "ui/session/typed_path.hpp"

namespace saccade {
namespace {

SensorMode mode_of(const SourceInfo& source) {
  return {source.size.width, source.size.height, cvRound(source.rate_hz)};
}

// Not on the thread that draws: a network disk may block.
std::optional<std::uint64_t> free_space(const std::filesystem::path& folder) {
  std::error_code code;
  const std::filesystem::space_info space = std::filesystem::space(folder, code);
  return code ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

std::filesystem::path folder_for_files() {
  std::error_code code;  // the folder may have been deleted
  const std::filesystem::path here = std::filesystem::current_path(code);
  const char* home = std::getenv("HOME");
  return (code || ::access(here.c_str(), W_OK) != 0) && home != nullptr ? home : here;
}

}  // namespace

SensorPanel::SensorPanel(DeviceWatch::List list_sensors, std::function<void()> wake)
    : usual_folder_(folder_for_files()), wake_(std::move(wake)), devices_(std::move(list_sensors), wake_) {}

std::filesystem::path SensorPanel::folder(const ViewContext& view) const {
  return view.state.folder.empty() ? usual_folder_ : std::filesystem::path(view.state.folder);
}

void SensorPanel::edit_folder(ViewContext& view) {
  if (!ImGui::IsAnyItemActive()) set_text(typed_folder_, view.state.folder);
  const char* button = "Choose…";
  const char* explanation =
      "For recordings and snapshots; empty = the folder in which the viewer was started";
  named_row("Output folder", explanation, [&] {
    const ImGuiStyle& style = ImGui::GetStyle();
    if (view.file_dialog)
      ImGui::SetNextItemWidth(
          -(ImGui::CalcTextSize(button).x + 2 * style.FramePadding.x + style.ItemSpacing.x));
    return ImGui::InputTextWithHint("##folder", usual_folder_.c_str(), typed_folder_.data(),
                                    typed_folder_.size());
  });
  log_place(view, "output folder");
  if (ImGui::IsItemDeactivatedAfterEdit()) set_folder(view, typed_path(typed_folder_.data()));
  if (!view.file_dialog) return;
  ImGui::SameLine();
  if (ImGui::Button(button))
    view.file_dialog(
        {FileDialog::Kind::open_folder, "Folder for recordings and snapshots", folder(view).string(), "", ""},
        [this, &view](const std::string& path) { set_folder(view, path); });
  log_place(view, "choose output folder");
  explain("By the desktop's own dialog");
}

void SensorPanel::set_folder(ViewContext& view, const std::string& typed) {
  std::error_code code;
  if (!typed.empty() && !std::filesystem::is_directory(typed, code))
    view.report("no such folder: " + typed + (code ? " (" + code.message() + ")" : ""));
  else if (!typed.empty() && ::access(typed.c_str(), W_OK) != 0)
    view.report("this folder cannot be written: " + typed);
  else if (const std::filesystem::path whole = typed.empty() ? "" : std::filesystem::absolute(typed, code);
           code)
    view.report("cannot use this folder: " + typed + " (" + code.message() + ")");
  else
    view.state.folder = whole.string();
}

SensorPanel::~SensorPanel() {
  if (tapped_ != nullptr) tapped_->set_tap({});
}

void SensorPanel::toggle_recording(ViewContext& view) {
  using Phase = RecordingStatus::Phase;
  const Phase phase = recording_->status().phase;
  if (phase == Phase::recording) return end_recording();
  if (phase != Phase::idle || view.source.phase != SessionState::Phase::open) return;
  tapped_ = &view.session.playback();
  OniWriterOptions options;
  options.rate_hz = view.source.source.rate_hz;
  options.expect_colour = view.source.source.live;
  const auto file = unused_path(folder(view), "recording", ".oni", std::chrono::system_clock::now());
  try {
    recording_->start(file, options);
    tapped_->set_tap([recording = recording_](const Frame& frame) { recording->offer(frame); });
    recording_reported_ = false;
    view.notify("Recording to " + file.string() +
                (view.playback.paused ? "; paused, so no frames come yet" : ""));
  } catch (const Error& error) {
    view.report(error.what());
  }
}

void SensorPanel::end_recording() {
  if (tapped_ != nullptr) tapped_->set_tap({});
  recording_->stop();
}

// Sensors that were connected since the first listing are offered.
void SensorPanel::poll_devices(ViewContext& view) {
  DeviceWatch::Seen seen = devices_.seen();
  if (seen.devices && view.sensors.devices) {
    const auto holds = [](const std::vector<DeviceChoice>& list, const std::string& source) {
      return std::ranges::count(list, source, &DeviceChoice::source) > 0;
    };
    for (const DeviceChoice& device : *seen.devices)
      if (!holds(*view.sensors.devices, device.source)) view.connected.push_back(device);
    std::erase_if(view.connected, [&](const auto& device) { return !holds(*seen.devices, device.source); });
  }
  if (view.source.source.live) view.connected.clear();
  if (seen.devices || seen.error != view.sensors.error) view.sensors = std::move(seen);
}

void SensorPanel::poll(ViewContext& view) {
  poll_devices(view);
  poll_snapshot(view);
  if (snapshot_due_) snapshot(view);
  if (view.source.phase != SessionState::Phase::open) end_recording();
  view.recording = recording_->status();
  if (recording_reported_ || view.recording.phase != RecordingStatus::Phase::idle) return;
  recording_reported_ = true;
  end_recording();  // it may have ended because of an error
  if (view.recording.frames > 0) view.recorded = view.recording.file.string();
  if (!view.recording.error.empty()) view.report(view.recording.error);
}

void SensorPanel::snapshot(ViewContext& view) {
  if (!view.result || writing_.valid()) return;
  snapshot_due_ = view.result->draft;  // the whole map follows
  if (snapshot_due_) return;
  snapshot_ = "Writing the snapshot …";
  snapshot_error_.clear();
  writing_ = std::async(std::launch::async, [folder = folder(view), result = view.result,
                                             style = shown_style(view.state), wake = wake_] {
    struct Wake {  // also when the disk is full
      const std::function<void()>& call;
      ~Wake() { call(); }
    } const when_done{wake};
    return write_snapshot(folder, *result, style, std::chrono::system_clock::now());
  });
}

void SensorPanel::poll_snapshot(ViewContext& view) {
  if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  snapshot_.clear();
  try {
    view.snapshot = writing_.get().string();
    snapshot_ = "Snapshot in " + view.snapshot;
    view.notify("Snapshot: " + view.snapshot);
  } catch (const std::exception& error) {
    snapshot_error_ = error.what();
    view.report(snapshot_error_);
  }
}

void SensorPanel::poll_disk(const ViewContext& view) {
  constexpr std::chrono::seconds kPeriod{2};
  const auto now = std::chrono::steady_clock::now();
  if (measuring_.valid()) {
    if (measuring_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
      free_bytes_ = measuring_.get();
  } else if (now - measured_ > kPeriod) {
    measured_ = now;
    measuring_ = std::async(std::launch::async, [folder = folder(view)] { return free_space(folder); });
  }
}

SensorFacts SensorPanel::facts(const ViewContext& view) const {
  SensorFacts facts;
  facts.source = source_facts(view);
  facts.devices = view.sensors.devices;
  facts.devices_error = view.sensors.error;
  facts.modes = view.session.sensor_modes();
  facts.mode = mode_of(view.source.source);
  facts.values = view.session.sensor_values();
  facts.folder = folder(view).string();
  facts.free_bytes = free_bytes_;
  facts.recording = view.recording;
  facts.snapshot = snapshot_;
  facts.snapshot_error = snapshot_error_;
  return facts;
}

void SensorPanel::draw(ViewContext& view) {
  poll_disk(view);
  const SensorFacts now = facts(view);
  const SensorActions actions = draw_sensors(now, std::chrono::steady_clock::now(), view.fonts.large);
  for (const ItemPlace& place : actions.places) log_place(view, place);
  edit_folder(view);
  if (actions.toggle_recording) toggle_recording(view);
  if (actions.snapshot) snapshot(view);
  // The settings hold the wanted values; the viewer requests the changed ones from the sensor.
  SensorSettings& wanted = view.state.settings.a.sensor;
  if (actions.request) store_request(wanted, *actions.request, now.values);
  if (actions.mode) wanted.mode = actions.mode;
  if (actions.open) view.open(*actions.open);
}

}  // namespace saccade
