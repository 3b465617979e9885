#include "ui/window/viewer.hpp"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "core/error.hpp"
#include "core/png.hpp"
#include "ui/session/sensor_settings_sync.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kFramesAfterEvent = 3;  // ImGui's layout settles with the second, hovering with the third
constexpr double kRefresh_s = 0.25, kIdle_s = 60;
constexpr double kPatience_s = 1e9;  // with a sensor that is not connected: somebody sees that it is missing

}  // namespace

Viewer::Viewer(ViewState state, ViewerOptions options, Session::Open open_function,
               DeviceWatch::List list_sensors, SensorAdvice::Ask ask_advice)
    : state_(std::move(state)),
      options_(std::move(options)),
      session_(begin_session(std::move(open_function))),
      window_("Saccade", options_.size.value_or(state_.window), !options_.size, state_.ui_scale),
      view_(state_, *session_, graphics_),
      history_(state_.settings),
      advice_(std::move(ask_advice), [] { Window::wake(); }),
      portal_([] { Window::wake(); }),
      sidebar_(std::move(list_sensors), [] { Window::wake(); }),
      open_dialog_([] { Window::wake(); }),
      sent_{state_.settings.a, {}, {}},
      sent_sensor_(state_.settings.a.sensor) {
  set_window(true);
  view_.example = options_.example;
  view_.welcome = options_.welcome && state_.welcome;
  view_.act = [this](Action action) { act(action); };
  view_.open = [this](const std::string& uri) { open(uri); };
  if (!options_.log.empty()) log_.emplace(options_.log);
  scale_ui();
  if (!options_.paused) session_->playback().play();
}

Viewer::~Viewer() { set_window(false); }

// Opens the first source, which takes about as long as to make the window and goes on meanwhile.
std::unique_ptr<Session> Viewer::begin_session(Session::Open open_function) {
  share_source(state_.settings);
  auto session = std::make_unique<Session>(
      std::move(open_function), [this] { wake_window(); }, ComputeRequest{state_.settings.a, {}, {}});
  session->playback().pause();  // at the first frame, until the window is there
  if (!options_.source.uri.empty()) session->open(request_for(options_.source.uri));
  return session;
}

// The session outlives the window.
void Viewer::set_window(bool there) {
  const std::lock_guard lock(window_mutex_);
  window_there_ = there;
}

void Viewer::wake_window() {
  woken_ = true;
  const std::lock_guard lock(window_mutex_);
  if (window_there_) Window::wake();
}

void Viewer::run() {
  while (!window_.should_close()) {
    window_.wait(frames_due_ > 0 ? 0 : refresh_ ? kRefresh_s : kIdle_s);
    const auto begin = Clock::now();
    if (stopped_) window_.close();
    const bool event = window_.take_event();
    const bool woken = woken_.exchange(false);
    if (event)
      frames_due_ = kFramesAfterEvent;
    else if (woken)
      frames_due_ = std::max(frames_due_, view_.playback.paused ? kFramesAfterEvent : 1);
    else if (refresh_)
      frames_due_ = std::max(frames_due_, 1);
    poll();
    if (window_.hidden()) frames_due_ = 0;
    if (frames_due_ == 0) continue;
    --frames_due_;
    draw_frame();
    const double busy_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    ++frames_;
    view_.busy_ms = busy_ms;
    view_.longest_ms = std::max(view_.longest_ms, busy_ms);
    log_frame(busy_ms);
  }
  state_.window = window_.size();
  fit_.restore(state_.settings);
}

void Viewer::stop() noexcept {
  stopped_ = true;
  Window::wake();
}

// The result of the newest request is on its way.
bool Viewer::awaits_result() const {
  return view_.source.phase == SessionState::Phase::open && view_.result &&
         (view_.result->generation < generation_ || view_.result->draft);
}

// Takes over the session's news; cheap, and done while the window is hidden too.
void Viewer::poll() {
  SessionUpdate update = session_->poll();
  view_.source = std::move(update.state);
  view_.result = std::move(update.latest);
  view_.playback = session_->playback().state();
  if (view_.source.opened != opened_) start_with_source();
  for (const FrameRecord& record : update.records) {
    view_.timeline.add(record.index, record.strength, record.generation >= a_since_);
    view_.history.add(record.times, record.latency_ms, record.at);
  }
  if (view_.result && !view_.result->frame().colour.empty()) {
    view_.last_colour = view_.result->frame().colour;
    view_.last_colour_index = view_.result->frame().index;
  }
  follow_lock();
  poll_errors();
  poll_advice();
  captured_.count(view_.source.ledger.captured, Clock::now());
  view_.captured_hz = captured_.rate_hz();
  sidebar_.sensors().poll(view_);
  poll_files();
  const bool live = view_.source.source.live && view_.source.phase == SessionState::Phase::open;
  const bool recording = view_.recording.phase != RecordingStatus::Phase::idle;
  refresh_ = live || recording || !view_.notice.empty() || ImGui::GetIO().WantTextInput ||
             !view_.source.opening.empty();
}

// Finds the locked fixation in the frame on screen, and keeps the probe at it.
void Viewer::follow_lock() {
  view_.locked = -1;
  if (!view_.result || !view_.lock.locked()) return;
  const auto& fixations = view_.result->a.result.attention.fixations;
  view_.locked = view_.lock.find(fixations);
  if (view_.locked < 0) return;
  const Fixation& fixation = fixations[static_cast<std::size_t>(view_.locked)];
  view_.pinned = cv::Point(fixation.col, fixation.row);
  view_.pinned_on_b = false;
}

// The session has replaced its source.
void Viewer::start_with_source() {
  opened_ = view_.source.opened;
  sidebar_.sensors().end_recording();  // a recording holds one source
  view_.timeline.reset(view_.source.source.frame_count.value_or(0));
  view_.timeline_zoom.reset();
  view_.history.clear();
  view_.errors.clear();
  view_.recorded.clear();
  view_.last_colour.release();
  view_.lock.unlock();
  view_.pinned.reset();
  view_.measured.reset();
  if (view_.source.uri != options_.example) view_.welcome = false;
  reported_error_.clear();
  remember_source(state_, view_.source.uri);
  window_.set_title("Saccade: " + view_.source.uri);
  picture_.reset();
  cloud_.fit();
  view_.notes = fit_.fit(state_.settings, view_.source.source);
  if (has_stills(view_.source.source) && options_.screenshot.empty()) {
    paused_for_stills_ |= !session_->playback().state().paused;
    session_->playback().pause();
    if (view_.source.source.frame_count.value_or(2) > 1)
      view_.notify("Stills without times: the arrow keys go from one to the next, Space plays them");
  } else if (std::exchange(paused_for_stills_, false)) {
    session_->playback().play();
  }
}

void Viewer::poll_errors() {
  const SessionState& s = view_.source;
  std::string error;
  ExitStatus status = ExitStatus::unreadable;
  if (s.failed != failed_) {
    failed_ = s.failed;
    error = s.failure;
    status = s.failure_status;
  } else if (s.phase == SessionState::Phase::ended) {
    error = s.error;
    if (!error.empty())
      status = s.error_status;
    else if (s.ledger.processed == 0)
      error = "No frame could be used: " + s.uri +
              (s.rejected_reason.empty() ? "" : " (" + s.rejected_reason + ")");
    if (error == reported_error_) return;
    reported_error_ = error;
  }
  if (error.empty()) return;
  if (!options_.screenshot.empty()) throw Error(status, "no screenshot", error, "");
  view_.report(error);
}

// While the viewer waits for a sensor, it says why there may be none.
void Viewer::poll_advice() {
  const SessionState& s = view_.source;
  const bool waiting =
      s.phase == SessionState::Phase::open && s.connection.connection == SourceState::Connection::waiting;
  if (waiting != advice_.active()) waiting ? advice_.ask() : advice_.clear();
  view_.advice = advice_.poll();
}

// Opens what was dropped onto the window, and passes on what was chosen in a dialog of the desktop.
void Viewer::poll_files() {
  if (const std::vector<std::string> dropped = window_.take_dropped(); !dropped.empty()) {
    open_dialog_.close();
    if (dropped.size() > 1)
      view_.notify("Only one source is open at a time: the first of those dropped is opened");
    open(dropped.front());
  }
  if (const std::string error = portal_.poll(); !error.empty()) view_.report(error);
  if (!portal_.available())
    view_.file_dialog = nullptr;
  else if (!view_.file_dialog)
    view_.file_dialog = [this](const FileDialog& dialog, const auto& chosen) {
      show_file_dialog(dialog, chosen);
    };
}

void Viewer::show_file_dialog(FileDialog dialog, std::function<void(const std::string&)> chosen) {
  if (portal_.busy()) return view_.notify("A file dialog of the desktop is open already");
  dialog.parent = window_.portal_name();
  portal_.show(dialog, std::move(chosen));
}

void Viewer::scale_ui() {
  const double scale = state_.ui_scale > 0 ? state_.ui_scale : window_.screen_scale();
  if (scale != scale_ || view_.fonts.bold == nullptr) {
    view_.fonts = load_fonts(scale);
    window_.renew_fonts();
  } else if (theme_ == state_.theme) {
    return;
  }
  scale_ = view_.unit = scale;
  theme_ = state_.theme;
  view_.colours = &colours_of(theme_);
  apply_theme(theme_, scale);
}

void Viewer::draw_frame() {
  scale_ui();
  window_.begin_frame();
  handle_keys();
  view_.outputs = {};
  view_.can_undo = history_.can_undo();
  view_.can_redo = history_.can_redo();
  draw_window();
  share_source(state_.settings);
  history_.change(state_.settings);
  if (!ImGui::IsAnyItemActive()) history_.commit();
  send_compute_request();
  follow_sensor();
  window_.end_frame(view_.colours->behind, graphics_.take_renewed(), [this] { before_show(); });
}

void Viewer::send_compute_request() {
  if (state_.comparing() && same_settings(state_.settings.a, state_.settings.b) && !sent_.b)
    state_.settings.b.kernel = std::clamp(2 * state_.settings.a.kernel + 1, 3, 127);  // to have a difference
  ComputeRequest request{state_.settings.a, {}, view_.outputs};
  if (state_.comparing()) request.b = state_.settings.b;
  if (request == sent_) return;
  const bool a_changed = !same_settings(request.a, sent_.a);
  generation_ = session_->set_compute_request(request);
  sent_ = std::move(request);
  if (!a_changed) return;
  a_since_ = generation_;
  view_.timeline.age();
}

// Requests from an open sensor what has changed in its settings: by its controls, by undo or by a file.
void Viewer::follow_sensor() {
  if (view_.source.phase != SessionState::Phase::open || !view_.source.source.live) return;
  const SensorSettings& wanted = state_.settings.a.sensor;
  if (wanted.mode != sent_sensor_.mode) return open(view_.source.uri);
  const SensorValues request = changed_values(sent_sensor_, wanted);
  if (request != SensorValues{}) session_->request_sensor(request);
  sent_sensor_ = wanted;
}

OpenRequest Viewer::request_for(const std::string& uri) const {
  OpenRequest request{uri, {}, state_.settings.a.sensor};
  if (uri == options_.source.uri) request.range = options_.source.range;
  if (options_.screenshot.empty()) request.sensor.wait_s = kPatience_s;
  return request;
}

void Viewer::open(const std::string& uri) {
  sent_sensor_ = state_.settings.a.sensor;
  session_->open(request_for(uri));
  frames_due_ = kFramesAfterEvent;
}

void Viewer::before_show() {
  if (options_.screenshot.empty() || !view_.result || view_.result->computed < options_.after_frames ||
      awaits_result())
    return;
  frames_due_ = kFramesAfterEvent;
  if (--shot_countdown_ > 0) return;
  write_file(options_.screenshot, encode_png(window_.picture()));
  window_.close();
}

}  // namespace saccade
