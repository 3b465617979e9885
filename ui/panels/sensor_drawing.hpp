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

/// The source that is open, and how it does.
struct SourceFacts {
  bool open = false;  ///< false: nothing is, or it is being opened
  std::string uri{};
  bool live = false;
  bool paused = false;
  double rate_hz = 0;  ///< frames that came of late, a second
  SourceState connection{};
  std::string error{};  ///< what ended it; empty = nothing did
};

/// What the panel tells.
struct SensorFacts {
  SourceFacts source;
  std::optional<std::vector<DeviceChoice>> devices;  ///< none = not looked for yet
  std::string devices_error;                         ///< why they cannot be listed; empty = they can
  std::vector<SensorMode> modes;                     ///< of the sensor that is open; empty = not known
  SensorMode mode;                                   ///< the one that is used
  SensorValues values;                               ///< of the sensor; all empty = it has no controls
  std::string folder;                                ///< where recordings and snapshots go
  std::optional<std::uint64_t> free_bytes;           ///< there; none = not known
  RecordingStatus recording;
  std::string snapshot;  ///< where the last one went, or that it is being written; empty = there was none
  std::string snapshot_error;
};

/// What a person asked for by the panel's buttons.
struct SensorActions {
  std::optional<std::string> open{};      ///< a source
  std::optional<SensorMode> mode{};       ///< one of the modes
  std::optional<SensorValues> request{};  ///< only what was changed
  bool toggle_recording = false;
  bool snapshot = false;
  std::vector<ItemPlace> places{};  ///< of the mode, its choices, and the switches, by their texts
};

/// The state in a few words that can be read from across the room, and what they mean.
struct Headline {
  std::string text;
  Tone tone = Tone::plain;
};
Headline headline(const SourceFacts& source, std::chrono::steady_clock::time_point now);

/// The recording in one line: time, size, free space, drops; empty if there was none.
Headline recording_line(const RecordingStatus& recording);

/// The panel, with its headline in the font `large` (the present one if null). Within an ImGui window, on the
/// thread that draws.
SensorActions draw_sensors(const SensorFacts& facts, std::chrono::steady_clock::time_point now,
                           ImFont* large = nullptr);

}  // namespace saccade
