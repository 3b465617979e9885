#include "ui/viewer/viewer.hpp"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "core/error.hpp"
#include "core/png.hpp"
#include "ui/viewer/widgets.hpp"

namespace saccade {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kFramesAfterEvent = 3;  // ImGui's layout settles with the second, hovering with the third
constexpr double kSlowRefresh_s = 0.25, kIdle_s = 60, kHeartbeat_s = 0.025;

bool same_wishes(const Wishes& x, const Wishes& y) {
  return same_settings(x.a, y.a) && x.b.has_value() == y.b.has_value() &&
         (!x.b || same_settings(*x.b, *y.b)) && x.wants.levels == y.wants.levels &&
         x.wants.normals == y.wants.normals;
}

}  // namespace

Viewer::Viewer(ViewState state, ViewerOptions options, Session::Open open_function)
    : state_(std::move(state)),
      options_(std::move(options)),
      window_("Saccade", options_.size.value_or(state_.window)),
      session_(
          std::move(open_function),
          [this] {
            woken_ = true;
            Window::wake();
          },
          Wishes{state_.tuning.a, {}, {}}),
      view_(state_, session_),
      history_(state_.tuning),
      sent_{state_.tuning.a, {}, {}} {
  view_.act = [this](Action action) { act(action); };
  view_.open = [this](const std::string& uri) { open(uri); };
  if (!options_.log.empty()) log_.emplace(options_.log);
  scale_ui();
  if (options_.paused) session_.playback().pause();
  if (!options_.source.uri.empty()) {
    const OpenRequest first = options_.source;
    open(first.uri);
  }
}

void Viewer::run() {
  while (!window_.should_close()) {
    window_.wait(frames_due_ == 0 ? idle_s() : 0);
    const auto begin = Clock::now();
    if (stopped_) window_.close();
    const bool event = window_.take_event();
    const bool woken = woken_.exchange(false);
    if (event)
      frames_due_ = kFramesAfterEvent;
    else if (woken)
      frames_due_ = std::max(frames_due_, view_.playback.paused ? kFramesAfterEvent : 1);
    else if (refresh_ || computing())
      frames_due_ = std::max(frames_due_, 1);
    take_news();
    if (window_.hidden()) frames_due_ = 0;
    if (frames_due_ == 0) continue;
    --frames_due_;
    draw_frame();
    const double busy_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    ++frames_;
    drawn_at_ = begin;
    view_.busy_ms = busy_ms;
    view_.longest_ms = std::max(view_.longest_ms, busy_ms);
    log_frame(busy_ms);
  }
  state_.window = window_.size();
  fit_.restore(state_.tuning);
}

void Viewer::stop() noexcept {
  stopped_ = true;
  Window::wake();
}

double Viewer::idle_s() const {
  if (!computing()) return refresh_ ? kSlowRefresh_s : kIdle_s;
  const double since_s = std::chrono::duration<double>(Clock::now() - drawn_at_).count();
  return std::max(kHeartbeat_s - since_s, 1e-3);
}

// While it computes the window shows that it lives, however long that takes.
bool Viewer::computing() const { return view_.source.computing || awaits_result(); }

// A wish was sent and what it makes of the frame is on its way.
bool Viewer::awaits_result() const {
  return view_.source.phase == SessionState::Phase::open && view_.result &&
         (view_.result->generation < generation_ || view_.result->draft);
}

// What the session has for us; cheap, and done while the window is hidden too.
void Viewer::take_news() {
  view_.source = session_.state();
  view_.playback = session_.playback().state();
  const ViewResultPtr latest = session_.latest();
  if (latest && !view_.result) view_.timeline.reset(view_.source.source.frame_count.value_or(0));
  view_.result = latest;
  for (const FrameRecord& record : session_.take_records()) {
    view_.timeline.add(record.index, record.strength, record.generation >= a_since_);
    view_.history.add(record.times, record.latency_ms, record.at);
  }
  take_errors();
  fit_to_source();
  sidebar_.sensors().take_news(view_);
  for (const std::string& path : window_.take_dropped()) open(path);
  const bool live = view_.source.source.live && view_.source.phase == SessionState::Phase::open;
  const bool recording = view_.recording.phase != RecordingStatus::Phase::idle;
  refresh_ = live || recording || !view_.notice.empty() || ImGui::GetIO().WantTextInput ||
             view_.source.phase == SessionState::Phase::opening;
}

void Viewer::take_errors() {
  const SessionState& s = view_.source;
  if (s.phase != SessionState::Phase::ended) {
    told_error_.clear();
    return;
  }
  std::string error = s.error;
  if (error.empty() && s.ledger.processed == 0)
    error = "No frame could be used: " + s.uri +
            (s.rejected_reason.empty() ? "" : " (" + s.rejected_reason + ")");
  if (error.empty() || error == told_error_) return;
  if (!options_.screenshot.empty()) throw failed("no screenshot", error, "");
  told_error_ = error;
  view_.errors.push_back(error);
}

void Viewer::fit_to_source() {
  if (fitted_ || view_.source.phase != SessionState::Phase::open) return;
  fitted_ = true;
  view_.notes = fit_.fit(state_.tuning, view_.source.source);
}

void Viewer::scale_ui() {
  const double scale = state_.ui_scale > 0 ? state_.ui_scale : window_.screen_scale();
  if (scale != scale_ || !view_.bold) {
    view_.bold = load_fonts(scale);
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
  view_.wants = {};
  view_.renewed.clear();
  draw_window();
  if (!ImGui::IsAnyItemActive()) {
    history_.change(state_.tuning);
    history_.commit();
  }
  send_wishes();
  window_.end_frame(view_.colours->behind, view_.renewed, [this] { before_show(); });
}

void Viewer::draw_window() {
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("##saccade", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  const auto part = [&](const char* id, ImVec2 size, const auto& draw) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(view_.colours->panel));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view_.px(12), view_.px(8)});
    ImGui::BeginChild(id, size, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view_.px(8), view_.px(7)});
    draw();
    ImGui::PopStyleVar();
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
  };
  part("top", {0, ImGui::GetFrameHeight() + view_.px(16)}, [&] { draw_top_bar(view_); });
  ImGui::Dummy({0, view_.px(1)});
  const float sidebar = state_.sidebar ? view_.px(state_.sidebar_width) : 0;
  const float height = ImGui::GetContentRegionAvail().y;
  ImGui::BeginChild("body", {ImGui::GetContentRegionAvail().x - sidebar, height});
  draw_body(height);
  ImGui::EndChild();
  if (state_.sidebar) {
    ImGui::SameLine();
    part("sidebar", {0, height}, [&] { sidebar_.draw(view_); });
  }
  ImGui::PopStyleVar(2);
  draw_notice();
  open_dialog_.draw(view_);
  settings_dialog_.draw(view_);
  draw_help(view_, help_);
  ImGui::End();
}

void Viewer::draw_body(float height) {
  const float timeline = view_.source.source.live ? 0 : ImGui::GetFontSize() + view_.px(34 + 7 + 4);
  const float transport = ImGui::GetFrameHeight() + view_.px(16) + timeline;
  const float before = ImGui::GetCursorPosY();
  draw_errors(view_);
  const float errors = ImGui::GetCursorPosY() - before;
  ImGui::BeginChild("centre", {0, std::max(1.0F, height - transport - errors - view_.px(1))}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  draw_centre();
  ImGui::EndChild();
  ImGui::Dummy({0, view_.px(1)});
  ImGui::PushStyleColor(ImGuiCol_ChildBg, as_vec4(view_.colours->panel));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {view_.px(12), view_.px(8)});
  ImGui::BeginChild("transport", {0, transport}, false,
                    ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view_.px(8), view_.px(7)});
  draw_transport(view_);
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

void Viewer::draw_centre() {
  const bool both = state_.centre == Centre::both;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (state_.centre == Centre::cloud) view_.pointer.reset();
  if (state_.centre != Centre::cloud) {
    ImGui::BeginChild("picture", {both ? room.x / 2 - view_.px(1) : 0, 0}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    picture_.draw(view_);
    ImGui::EndChild();
  }
  view_.over_picture = nullptr;  // the side bar, which is drawn later, says it anew
  if (both) ImGui::SameLine(0, view_.px(2));
  if (state_.centre != Centre::picture) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view_.px(8), view_.px(7)});
    ImGui::BeginChild("cloud", {0, 0}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    cloud_.draw(view_);
    ImGui::EndChild();
    ImGui::PopStyleVar();
  }
}

void Viewer::draw_notice() {
  if (view_.notice.empty()) return;
  if (ImGui::GetTime() > view_.notice_until) {
    view_.notice.clear();
    return;
  }
  const ImVec2 size = ImGui::CalcTextSize(view_.notice.c_str()), screen = ImGui::GetIO().DisplaySize;
  const ImVec2 pad{view_.px(14), view_.px(8)};
  const ImVec2 corner{(screen.x - size.x) / 2 - pad.x, view_.px(64)};
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  draw.AddRectFilled(corner, {corner.x + size.x + 2 * pad.x, corner.y + size.y + 2 * pad.y},
                     IM_COL32(20, 24, 29, 235), view_.px(8));
  draw.AddText({corner.x + pad.x, corner.y + pad.y}, IM_COL32(235, 238, 242, 255), view_.notice.c_str());
}

void Viewer::send_wishes() {
  if (state_.comparing() && same_settings(state_.tuning.a, state_.tuning.b) && !sent_.b)
    state_.tuning.b.kernel = std::clamp(2 * state_.tuning.a.kernel + 1, 3, 127);  // something to compare with
  Wishes wishes{state_.tuning.a, {}, view_.wants};
  if (state_.comparing()) wishes.b = state_.tuning.b;
  if (same_wishes(wishes, sent_)) return;
  const bool a_changed = !same_settings(wishes.a, sent_.a);
  generation_ = session_.set_wishes(wishes);
  sent_ = std::move(wishes);
  if (!a_changed) return;
  a_since_ = generation_;
  view_.timeline.age();
}

void Viewer::open(const std::string& uri) {
  OpenRequest request{uri, {}, options_.source.intrinsics, state_.tuning.a.sensor};
  if (uri == options_.source.uri) request.range = options_.source.range;
  sidebar_.sensors().end_recording();  // a file is of one source
  session_.open(request);
  view_.result.reset();
  view_.timeline.reset(0);
  view_.history.clear();
  view_.errors.clear();
  view_.notes.clear();
  fitted_ = false;
  told_error_.clear();
  if (!uri.empty()) remember_source(state_, uri);
  window_.set_title("Saccade: " + uri);
  picture_.forget();
  cloud_.fit();
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

void Viewer::log_frame(double busy_ms) {
  if (!log_) return;
  const Settings& a = state_.tuning.a;
  const cv::Size window = window_.size();
  nlohmann::ordered_json line = {
      {"t_ms", std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count()},
      {"busy_ms", busy_ms},
      {"longest_ms", view_.longest_ms},
      {"frames", frames_},
      {"source", view_.source.uri},
      {"phase", static_cast<int>(view_.source.phase)},
      {"errors", view_.errors},
      {"notes", view_.notes},
      {"paused", view_.playback.paused},
      {"position", view_.playback.position},
      {"speed", view_.playback.speed},
      {"model", a.model},
      {"kernel", a.kernel},
      {"comparison", static_cast<int>(state_.comparison)},
      {"divider", state_.divider},
      {"generation", generation_},
      {"window", {window.width, window.height}},
      {"processed", view_.source.ledger.processed},
      {"recording", view_.recording.phase != RecordingStatus::Phase::idle},
      {"recorded", {{"file", view_.recording.file.string()}, {"frames", view_.recording.frames}}},
      {"snapshot", view_.snapshot},
      {"places", view_.places}};
  if (view_.result) {
    const Computed& shown = view_.result->a;
    line["shown"] = {{"index", view_.result->frame().index},
                     {"serial", view_.result->serial},
                     {"generation", view_.result->generation},
                     {"model", shown.settings.model},
                     {"kernel", shown.settings.kernel},
                     {"fixations", shown.result.attention.fixations.size()},
                     {"compared", view_.result->compared},
                     {"error", shown.error},
                     {"draft", view_.result->draft}};
  }
  log_->append(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace saccade
