#include "ui/viewer/sensor_section.hpp"

#include <unistd.h>

#include <cstdlib>

#include <fmt/format.h>

#include "core/error.hpp"
#include "drivers/openni2_devices.hpp"
#include "ui/snapshot.hpp"
#include "ui/viewer/window.hpp"

namespace saccade {
namespace {

// What sensors of this kind offer; one that lacks a mode says what it has when it is opened.
const std::vector<std::string> kUsualModes = {"640x480@30", "320x240@60", "320x240@30", "1280x1024@30"};

std::vector<DeviceChoice> connected_sensors() {
  std::vector<DeviceChoice> choices;
  for (const DeviceListing& device : list_devices())
    choices.push_back({device.identity.name.empty() ? device.identity.uri : device.identity.name,
                       device.source, device.driver.empty() ? device.identity.vendor : device.driver});
  return choices;
}

std::string mode_text(const SourceInfo& source) {
  return fmt::format("{}x{}@{:.0f}", source.size.width, source.size.height, source.rate_hz);
}

std::filesystem::path folder_for_files() {
  const std::filesystem::path here = std::filesystem::current_path();
  const char* home = std::getenv("HOME");
  return ::access(here.c_str(), W_OK) != 0 && home != nullptr ? home : here;
}

}  // namespace

SensorSection::SensorSection()
    : folder_(folder_for_files()), devices_(connected_sensors, [] { Window::wake(); }) {}

SensorSection::~SensorSection() {
  if (tapped_ != nullptr) tapped_->set_tap({});
}

void SensorSection::toggle_recording(ViewContext& view) {
  using Phase = RecordingStatus::Phase;
  const Phase phase = recording_->status().phase;
  if (phase == Phase::recording) return end_recording();
  if (phase != Phase::idle || view.source.phase != SessionState::Phase::open) return;
  tapped_ = &view.session.playback();
  OniWriterOptions options;
  options.rate_hz = view.source.source.rate_hz;
  options.expect_colour = view.source.source.live;
  const auto file = unused_path(folder_, "recording", ".oni", std::chrono::system_clock::now());
  try {
    recording_->start(file, options);
    tapped_->set_tap([recording = recording_](const Frame& frame) { recording->offer(frame); });
    recording_told_ = false;
    view.tell("Recording to " + file.string() +
              (view.playback.paused ? "; paused, so no frames come yet" : ""));
  } catch (const Error& error) {
    view.errors.emplace_back(error.what());
  }
}

void SensorSection::end_recording() {
  if (tapped_ != nullptr) tapped_->set_tap({});
  recording_->stop();
}

void SensorSection::take_news(ViewContext& view) {
  take_snapshot_result(view);
  if (snapshot_due_) snapshot(view);
  view.recording = recording_->status();
  if (recording_told_ || view.recording.phase != RecordingStatus::Phase::idle) return;
  recording_told_ = true;
  end_recording();  // it may have ended by itself
  if (view.recording.error.empty())
    view.tell(fmt::format("Recorded {} frames: {}", view.recording.frames, view.recording.file.string()));
  else
    view.errors.push_back(view.recording.error);
}

void SensorSection::snapshot(ViewContext& view) {
  if (!view.result || writing_.valid()) return;
  snapshot_due_ = view.result->draft;  // the whole map is on its way
  if (snapshot_due_) return;
  snapshot_ = "writing the snapshot ...";
  snapshot_error_.clear();
  OverlayStyle style = view.state.style;
  if (!view.state.show_map) style.map.opacity = 0;
  writing_ = std::async(std::launch::async, [folder = folder_, result = view.result, style] {
    struct Wake {  // also when the disk is full
      ~Wake() { Window::wake(); }
    } const wake;
    return write_snapshot(folder, result->a.result, style, std::chrono::system_clock::now());
  });
}

void SensorSection::take_snapshot_result(ViewContext& view) {
  if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  snapshot_.clear();
  try {
    view.snapshot = writing_.get().string();
    snapshot_ = "snapshot in " + view.snapshot;
    view.tell("Snapshot: " + view.snapshot);
  } catch (const std::exception& error) {
    snapshot_error_ = error.what();
    view.errors.push_back(snapshot_error_);
  }
}

// What comes from the source, computed or not.
double SensorSection::captured_rate_hz(const Ledger& ledger) {
  constexpr std::chrono::seconds kRecent{2};
  const auto now = std::chrono::steady_clock::now();
  if (!captured_.empty() && ledger.captured < captured_.back().frames) captured_.clear();  // another source
  captured_.push_back({now, ledger.captured});
  while (now - captured_.front().at > kRecent && captured_.size() > 2) captured_.pop_front();
  const double span_s = std::chrono::duration<double>(now - captured_.front().at).count();
  return span_s > 0 ? static_cast<double>(ledger.captured - captured_.front().frames) / span_s : 0;
}

SensorFacts SensorSection::facts(const ViewContext& view) {
  SensorFacts facts;
  const SessionState& session = view.source;
  facts.source.open = session.phase == SessionState::Phase::open;
  facts.source.uri = session.uri;
  facts.source.live = session.source.live;
  facts.source.paused = view.playback.paused;
  facts.source.rate_hz = captured_rate_hz(session.ledger);
  facts.source.connection = session.connection;
  facts.source.error = session.error;
  const DeviceWatch::Seen seen = devices_.seen();
  facts.devices = seen.devices;
  facts.devices_error = seen.error;
  if (facts.source.open && session.source.kind == "openni2") {
    facts.modes = kUsualModes;
    facts.mode = mode_text(session.source);
    facts.values = view.session.sensor_values();
  }
  facts.folder = folder_.string();
  facts.recording = view.recording;
  facts.snapshot = snapshot_;
  facts.snapshot_error = snapshot_error_;
  return facts;
}

void SensorSection::draw(ViewContext& view) {
  const SensorActions actions = draw_sensor_panel(facts(view), std::chrono::steady_clock::now());
  if (actions.toggle_recording) toggle_recording(view);
  if (actions.snapshot) snapshot(view);
  if (actions.request) view.session.request_sensor(*actions.request);
  if (actions.open) view.open(*actions.open);
  if (actions.mode) {
    apply_setting(view.state.tuning.a, "mode", *actions.mode);
    view.open(view.source.uri);
  }
}

}  // namespace saccade
