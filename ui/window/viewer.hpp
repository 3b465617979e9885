#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/file.hpp"
#include "ui/drawing/gl_graphics.hpp"
#include "ui/panels/cloud_panel.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/view_context.hpp"
#include "ui/session/rate_meter.hpp"
#include "ui/session/settings_history.hpp"
#include "ui/session/source_fit.hpp"
#include "ui/window/window.hpp"

namespace saccade {

struct ViewerOptions {
  OpenRequest source;             ///< opened at the start; an empty uri opens nothing
  std::optional<cv::Size> size;   ///< of the window, instead of that of the last time
  std::string screenshot;         ///< PNG to write and then to end; empty = stay
  std::int64_t after_frames = 1;  ///< so many computed frames are waited for before the screenshot
  std::string log;                ///< JSON lines of every frame of the window; empty = none
  bool paused = false;            ///< starts with the first frame and waits
};

/// The window and all in it, on the thread that makes it. Computation is the session's; nothing here waits
/// for it.
class Viewer {
 public:
  /// `state` as it was kept. Throws Error (failed) where there is no display or no OpenGL 3.3.
  Viewer(ViewState state, ViewerOptions options, Session::Open open, DeviceWatch::List list_sensors);

  /// Until the window is closed, or the screenshot is written. Throws Error (failed) if the screenshot cannot
  /// be made.
  void run();

  /// Ends run() soon. Any thread.
  void stop() noexcept;

  /// What a person set, to be kept.
  const ViewState& state() const { return state_; }

 private:
  double idle_s() const;
  bool computing() const;
  bool awaits_result() const;
  void poll();
  void poll_errors();
  void fit_to_source();
  void draw_frame();
  void draw_window();
  void draw_body(float height);
  void draw_centre();
  void draw_notice();
  void handle_keys();
  void act(Action action);
  bool act_on_playback(Action action);
  bool act_on_tuning(Action action);
  bool act_on_picture(Action action);
  void act_on_window(Action action);
  void copy_command();
  void send_compute_request();
  void follow_sensor();
  void open(const std::string& uri);
  void scale_ui();
  void before_show();
  void log_frame(double busy_ms);

  ViewState state_;
  ViewerOptions options_;
  std::atomic<bool> woken_ = true, stopped_ = false;
  Window window_;
  GlGraphics graphics_;
  Session session_;
  ViewContext view_;
  SettingsHistory history_;
  SourceFit fit_;
  bool fitted_ = false;  // to the source that is open
  PicturePanel picture_;
  CloudPanel cloud_;
  Sidebar sidebar_;
  OpenDialog open_dialog_;
  SettingsDialog settings_dialog_;
  bool help_ = false;
  ComputeRequest sent_;
  SensorSettings sent_sensor_;
  RateMeter captured_;
  std::int64_t generation_ = 0, a_since_ = 0;  // of the wishes sent last; since when A is what it is
  double scale_ = 0;
  Theme theme_ = Theme::dark;
  int frames_due_ = 3;
  bool refresh_ = false;  // something changes with time alone
  std::string reported_error_;
  std::optional<LineFile> log_;
  std::int64_t frames_ = 0;
  std::chrono::steady_clock::time_point drawn_at_{};
  int shot_countdown_ = 3;  // frames for the layout to settle
};

}  // namespace saccade
