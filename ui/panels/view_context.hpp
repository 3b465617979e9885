#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>
#include <nlohmann/json.hpp>
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

/// What a panel may see and touch while a frame of the window is drawn; all on the window's thread. Panels
/// change `state`; the viewer tells the session what that means for the computation.
struct ViewContext {
  ViewContext(ViewState& its_state, Session& its_session, Graphics& its_graphics)
      : state(its_state), session(its_session), graphics(its_graphics) {}

  ViewState& state;
  Session& session;
  Graphics& graphics;
  // As they are at this frame:
  ViewResultPtr result;  ///< null = nothing computed yet
  SessionState source;
  PlaybackState playback;
  // Of the source that is open:
  Timeline timeline;
  StageHistory history;
  RequestedOutputs outputs;  ///< by-products that a panel needs; cleared before each frame

  RecordingStatus recording;  ///< of the recording that runs, or of the last one
  std::string snapshot;       ///< folder of the last snapshot; empty = there was none

  double captured_hz = 0;  ///< frames that came from the source of late, computed or not
  bool can_undo = false, can_redo = false;

  double busy_ms = 0, longest_ms = 0;  ///< what the window's last frame took to draw; the longest of all

  double unit = 1;  ///< pixels of ImGui for one of a screen of usual density
  Fonts fonts;
  const ThemeColours* colours = nullptr;

  std::optional<cv::Point> pointer;  ///< pixel of the frame under the mouse
  bool pointer_on_b = false;         ///< it is over B's picture
  /// Draws over the picture with the next frame of the window; may be empty.
  std::function<void(ImDrawList&, const PicturePlace&)> over_picture;

  std::vector<ImTextureID> renewed;  ///< textures whose pixels have changed; cleared before each frame

  std::vector<std::string> errors;  ///< to be shown until they are put away; one line each
  std::vector<std::string> notes;   ///< what is to be known of the source, until it is put away
  std::string notice;               ///< a short "done" line; goes by itself
  double notice_until = 0;          ///< ImGui's time

  std::function<void(Action)> act;                   ///< does what a shortcut does
  std::function<void(const std::string& uri)> open;  ///< opens a source

  nlohmann::json places;  ///< where things are in the window, for the log; tests find sliders there

  float px(double pixels) const { return static_cast<float>(pixels * unit); }
  void notify(std::string line);  ///< sets the notice
  /// The computation under the pointer, or A's.
  const Computed* pointed() const {
    return result == nullptr ? nullptr : pointer_on_b && result->compared ? &result->b : &result->a;
  }
};

}  // namespace saccade
