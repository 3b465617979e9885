#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/frame_source.hpp"
#include "core/sensor_controls.hpp"
#include "ui/panels/panel_text.hpp"
#include "ui/session/device_watch.hpp"
#include "ui/session/recording_session.hpp"

namespace saccade {

/// The open source and its state.
struct SourceFacts {
  bool open = false;
  bool opening = false;  ///< no source is open, and one is being opened
  std::string uri{};
  bool live = false;
  bool paused = false;
  double rate_hz = 0;  ///< present frames per second
  SourceState connection{};
  std::string error{};  ///< what ended it; empty = no error
};

/// What the panel shows.
struct SensorFacts {
  SourceFacts source;
  std::optional<std::vector<DeviceChoice>> devices;  ///< none = not listed yet
  std::string devices_error;                         ///< why they cannot be listed; empty = no error
  std::vector<SensorMode> modes;                     ///< of the open sensor; empty = not known
  SensorMode mode;                                   ///< the present one
  SensorValues values;                               ///< of the sensor; empty = it has no controls
  std::string folder;                                ///< where recordings and snapshots go
  std::optional<std::uint64_t> free_bytes;           ///< there; none = not known
  RecordingStatus recording;
  std::string snapshot;  ///< the place of the last one, or that it is being written; empty = none yet
  std::string snapshot_error;
};

/// What the user requested by the panel's controls.
struct SensorActions {
  std::optional<std::string> open{};      ///< a source
  std::optional<SensorMode> mode{};       ///< one of the modes
  std::optional<SensorValues> request{};  ///< only the changed values
  bool toggle_recording = false;
  bool snapshot = false;
  std::vector<ItemPlace> places{};  ///< of the mode, its choices, and the switches, by their labels
};

/// The state in a few words, to be read from across the room.
struct Headline {
  std::string text;
  Tone tone = Tone::plain;
};
[[nodiscard]] Headline headline(const SourceFacts& source, std::chrono::steady_clock::time_point now);

/// The recording in one line: time, size, free space, drops; empty if there was none.
[[nodiscard]] Headline recording_line(const RecordingStatus& recording);

/// Draws the panel, with its headline in the font `large` (the present one if null). Within an ImGui window,
/// on the thread that draws.
[[nodiscard]] SensorActions draw_sensors(const SensorFacts& facts, std::chrono::steady_clock::time_point now,
                                         ImFont* large = nullptr);

}  // namespace saccade
