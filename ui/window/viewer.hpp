#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/file.hpp"
#include "ui/drawing/gl_graphics.hpp"
#include "ui/panels/cloud_panel.hpp"
#include "ui/panels/open_dialog.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/settings_dialog.hpp"
#include "ui/panels/view_context.hpp"
#include "ui/session/file_portal.hpp"
#include "ui/session/rate_meter.hpp"
#include "ui/session/sensor_advice.hpp"
#include "ui/session/settings_history.hpp"
#include "ui/session/source_fit.hpp"
#include "ui/window/window.hpp"

namespace saccade {

struct ViewerOptions {
  OpenRequest source;             ///< opened at the start; an empty uri opens nothing
  std::optional<cv::Size> size;   ///< of the window, instead of that of the last time
  std::string screenshot;         ///< PNG file; the viewer ends once it is written; empty = none
  std::int64_t after_frames = 1;  ///< computed frames before the screenshot
  std::string example;            ///< path of the bundled recording; empty = it is not there
  std::string log;                ///< file for a line of JSON per frame of the window; empty = none
  bool welcome = false;           ///< shows the welcome card, unless the user has turned that off
  bool paused = false;            ///< starts paused at the first frame
};

/// The window and its contents, on the thread that makes it. The session computes; nothing here waits for it.
class Viewer {
 public:
  /// Starts with a saved `state`. Throws Error (failed) where there is no display or no OpenGL 3.3.
  Viewer(ViewState state, ViewerOptions options, Session::Open open, DeviceWatch::List list_sensors,
         SensorAdvice::Ask ask_advice);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Runs until the window is closed or the screenshot is written. Throws Error (failed) if that is
  /// impossible.
  void run();

  /// Ends run() soon. Any thread.
  void stop() noexcept;

  /// The state to save.
  [[nodiscard]] const ViewState& state() const { return state_; }

 private:
  std::unique_ptr<Session> begin_session(Session::Open open_function);
  void set_window(bool there);
  void wake_window();
  OpenRequest request_for(const std::string& uri) const;
  bool awaits_result() const;
  void poll();
  void start_with_source();
  void follow_lock();
  void poll_errors();
  void poll_advice();
  void poll_files();
  void draw_frame();
  void draw_window();
  void draw_splitter(float height);
  void draw_body(float height);
  void draw_centre();
  void draw_notice(float body);
  void handle_keys();
  void act(Action action);
  void escape();
  bool move_pin(const Window::KeyPress& press);
  bool act_on_playback(Action action);
  bool act_on_tuning(Action action);
  bool act_on_picture(Action action);
  void act_on_window(Action action);
  void copy_command();
  void paste_source();
  void show_file_dialog(FileDialog dialog, std::function<void(const std::string&)> chosen);
  void send_compute_request();
  void follow_sensor();
  void open(const std::string& uri);
  void scale_ui();
  void before_show();
  void log_frame(double busy_ms);

  ViewState state_;
  ViewerOptions options_;
  std::atomic<bool> woken_ = true, stopped_ = false;
  std::mutex window_mutex_;
  bool window_there_ = false;  // guarded by window_mutex_
  const std::unique_ptr<Session> session_;
  Window window_;
  GlGraphics graphics_;
  ViewContext view_;
  SettingsHistory history_;
  SourceFit fit_;
  SensorAdvice advice_;
  FilePortal portal_;
  PicturePanel picture_;
  CloudPanel cloud_;
  Sidebar sidebar_;
  OpenDialog open_dialog_;
  SettingsDialog settings_dialog_;
  HelpDialog help_;
  ComputeRequest sent_;
  SensorSettings sent_sensor_;
  RateMeter captured_;
  std::int64_t generation_ = 0, a_since_ = 0;  // of the last request; of the first one with the present A
  double scale_ = 0;
  Theme theme_ = Theme::dark;
  int frames_due_ = 3;
  bool refresh_ = false;                  // something on screen changes with time
  std::int64_t opened_ = 0, failed_ = 0;  // sources, as the window has reported them
  bool paused_for_stills_ = false;        // not by the user
  std::string reported_error_;            // of the present source
  std::optional<LineFile> log_;
  std::int64_t frames_ = 0;
  int shot_countdown_ = 3;  // frames for the layout to settle
};

}  // namespace saccade
