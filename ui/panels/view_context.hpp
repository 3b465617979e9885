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
#include "ui/session/device_watch.hpp"
#include "ui/session/file_portal.hpp"
#include "ui/session/fixation_lock.hpp"
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
  TimelineZoom timeline_zoom;
  StageHistory history;
  RequestedOutputs outputs;  ///< by-products that a panel requests; cleared before each frame

  DeviceWatch::Seen sensors;            ///< the connected sensors
  std::vector<DeviceChoice> connected;  ///< sensors connected just now, which are offered to the user
  std::string example;                  ///< path of the bundled recording; empty = it is not there

  RecordingStatus recording;  ///< the running recording, or the last one
  std::string recorded;  ///< a recording that has ended just now and is offered to be played; empty = none
  std::string snapshot;  ///< folder of the last snapshot; empty = none yet

  double captured_hz = 0;  ///< present rate of the source, with frames that are not computed
  bool can_undo = false, can_redo = false;

  double busy_ms = 0, longest_ms = 0;  ///< drawing time of the window's last frame, and of the longest

  double unit = 1;  ///< pixels of ImGui per pixel of a screen of usual density
  Fonts fonts;
  const ThemeColours* colours = nullptr;

  std::optional<cv::Point> pointer;  ///< pixel of the frame under the mouse
  bool pointer_on_b = false;         ///< over B's picture
  std::optional<cv::Point> pinned;   ///< pixel at which the user has pinned the probe
  bool pinned_on_b = false;
  std::optional<cv::Point> measured;  ///< other end of a distance that is measured from the pinned pixel

  FixationLock lock;
  int locked = -1;                    ///< index of the locked fixation of A in this frame; -1 = none
  int hovered_mark = -1;              ///< index of the fixation whose mark is under the mouse; -1 = none
  int hovered_row = -1;               ///< the same for the rows of the table, as of the last frame
  std::optional<Fixation> centre_on;  ///< to be shown in the middle of picture and cloud

  bool welcome = false;   ///< the welcome card is shown
  cv::Mat3b last_colour;  ///< the last colour image of the source; empty = none yet
  std::int64_t last_colour_index = 0;
  /// Draws over the picture in the next frame of the window; may be empty.
  std::function<void(ImDrawList&, const PicturePlace&)> over_picture;

  std::vector<std::string> errors;  ///< shown until the user dismisses them; see report()
  std::vector<std::string> notes;   ///< about the source; shown until the user dismisses them
  std::vector<std::string> advice;  ///< why there may be no sensor, one line each; while one is waited for
  std::string notice;               ///< a short message that disappears by itself
  double notice_until = 0;          ///< ImGui's time

  std::function<void(Action)> act;                   ///< performs an action
  std::function<void(const std::string& uri)> open;  ///< opens a source
  /// Shows a file dialog of the desktop, whose choice `chosen` gets later; null = the desktop has none.
  std::function<void(FileDialog dialog, std::function<void(const std::string& path)> chosen)> file_dialog;

  std::map<std::string, std::array<float, 4>>
      places;  ///< of the controls in the window, for its log: [left, top, right, bottom]

  float px(double pixels) const { return static_cast<float>(pixels * unit); }
  /// The frame on screen; one without colour gets the last colour image, so that the picture does not flash.
  Frame shown_frame() const {
    Frame frame = result->frame();
    if (frame.colour.empty() && last_colour.size() == frame.size()) frame.colour = last_colour;
    return frame;
  }
  /// The point of a pixel in the camera frame, mm; none where there is no reading, or no such pixel.
  std::optional<cv::Point3d> point_at(std::optional<cv::Point> pixel) const;
  void notify(const std::string& line);  ///< sets the notice, which stays for some seconds
  /// Adds an error, unless it is the last one already. A long one, of a long path, is shortened in its
  /// middle.
  void report(const std::string& error);
  /// The computation under the pointer, or A's.
  const Computed* pointed() const {
    return result == nullptr ? nullptr : pointer_on_b && result->compared ? &result->b : &result->a;
  }
};

}  // namespace saccade
