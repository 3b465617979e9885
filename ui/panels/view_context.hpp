#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "ui/panels/probe_drawing.hpp"
#include "ui/panels/theme.hpp"
#include "ui/session/graphics.hpp"
#include "ui/session/overlay_shapes.hpp"
#include "ui/session/recording_session.hpp"
#include "ui/session/session.hpp"
#include "ui/session/shortcuts.hpp"
#include "ui/session/stage_history.hpp"
#include "ui/session/timeline.hpp"
#include "ui/session/view_state.hpp"

namespace saccade {

/// What panels read and change while a frame of the window is drawn; all on the window's thread. Panels
/// change `state`; the viewer passes changes on to the session.
struct ViewContext {
  ViewContext(ViewState& its_state, Session& its_session, Graphics& its_graphics)
      : state(its_state), session(its_session), graphics(its_graphics) {}

  ViewState& state;
  Session& session;
  Graphics& graphics;
  // As of this frame:
  ViewResultPtr result;  ///< null = nothing computed yet
  SessionState source;
  PlaybackState playback;
  // Of the open source:
  Timeline timeline;
  StageHistory history;
  RequestedOutputs outputs;  ///< by-products that a panel requests; cleared before each frame

  RecordingStatus recording;  ///< the running recording, or the last one
  std::string snapshot;       ///< folder of the last snapshot; empty = none yet

  double captured_hz = 0;  ///< present rate of the source, with frames that are not computed
  bool can_undo = false, can_redo = false;

  double busy_ms = 0, longest_ms = 0;  ///< drawing time of the window's last frame, and of the longest

  double unit = 1;  ///< pixels of ImGui per pixel of a screen of usual density
  Fonts fonts;
  const ThemeColours* colours = nullptr;

  std::optional<cv::Point> pointer;  ///< pixel of the frame under the mouse
  bool pointer_on_b = false;         ///< over B's picture
  /// Draws over the picture in the next frame of the window; may be empty.
  std::function<void(ImDrawList&, const PicturePlace&)> over_picture;

  std::vector<std::string> errors;  ///< shown until the user dismisses them; one line each
  std::vector<std::string> notes;   ///< about the source; shown until the user dismisses them
  std::string notice;               ///< a short message that disappears by itself
  double notice_until = 0;          ///< ImGui's time

  std::function<void(Action)> act;                   ///< performs an action
  std::function<void(const std::string& uri)> open;  ///< opens a source

  std::map<std::string, std::array<float, 4>>
      places;  ///< of the controls in the window, for its log: [left, top, right, bottom]

  float px(double pixels) const { return static_cast<float>(pixels * unit); }
  void notify(std::string line);  ///< sets the notice, which stays for some seconds
  /// The computation under the pointer, or A's.
  const Computed* pointed() const {
    return result == nullptr ? nullptr : pointer_on_b && result->compared ? &result->b : &result->a;
  }
};

}  // namespace saccade
