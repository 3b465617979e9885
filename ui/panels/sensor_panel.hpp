#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "ui/panels/sensor_drawing.hpp"
#include "ui/panels/view_context.hpp"
#include "ui/session/device_watch.hpp"
#include "ui/session/recording_session.hpp"

namespace saccade {

/// Sensors, recording and snapshots in the side bar. Files go to ViewState::folder; without one to the
/// working directory, or to the user's home where that is not writable.
class SensorPanel {
 public:
  /// `list_sensors` may throw; it is called on a thread of its own. `wake` is called on any thread when there
  /// is something new to draw.
  SensorPanel(DeviceWatch::List list_sensors, std::function<void()> wake);
  ~SensorPanel();
  SensorPanel(const SensorPanel&) = delete;
  SensorPanel& operator=(const SensorPanel&) = delete;

  void draw(ViewContext& view);

  /// Reports connected sensors, finished recordings and snapshots. Each frame, also when the panel is closed.
  void poll(ViewContext& view);

  void toggle_recording(ViewContext& view);
  /// Ends a recording, before its source is closed.
  void end_recording();
  void snapshot(ViewContext& view);

 private:
  SensorFacts facts(const ViewContext& view) const;
  void poll_devices(ViewContext& view);
  void poll_snapshot(ViewContext& view);
  void poll_disk(const ViewContext& view);

  std::filesystem::path folder(const ViewContext& view) const;
  void edit_folder(ViewContext& view);
  void set_folder(ViewContext& view, const std::string& typed);

  const std::filesystem::path usual_folder_;
  std::array<char, 4096> typed_folder_{};
  const std::function<void()> wake_;
  // Shared with the capture thread, which may still be in it when a recording or the viewer ends.
  const std::shared_ptr<RecordingSession> recording_ = std::make_shared<RecordingSession>();
  PlaybackControls* tapped_ = nullptr;
  DeviceWatch devices_;
  std::future<std::optional<std::uint64_t>> measuring_;  // free_bytes_, on its way
  std::chrono::steady_clock::time_point measured_{};
  std::optional<std::uint64_t> free_bytes_;     // of the folder's disk
  std::future<std::filesystem::path> writing_;  // the snapshot that is being written
  bool snapshot_due_ = false;                   // once the whole map is there
  std::string snapshot_, snapshot_error_;
  bool recording_reported_ = true;  // the end of the last one
};

}  // namespace saccade
