// The actions of shortcuts and buttons.
#include <algorithm>

#include <imgui.h>

#include "ui/panels/widgets.hpp"
#include "ui/session/command_line.hpp"
#include "ui/session/typed_path.hpp"
#include "ui/window/viewer.hpp"

namespace saccade {
namespace {

// A bound at the frame on screen; none if it is there already, or if there is no frame.
std::optional<std::int64_t> marked(std::optional<std::int64_t> bound, std::int64_t position) {
  return position < 0 || bound == position ? std::nullopt : std::optional(position);
}

}  // namespace

void Viewer::handle_keys() {
  const bool typing = ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId);
  for (const Window::KeyPress& press : window_.take_keys()) {
    if (press.key == Key::escape) {
      escape();
      continue;
    }
    if (!typing && move_pin(press)) continue;
    const auto action = action_of(press.key, press.ctrl, press.shift);
    const bool closes_help = action == Action::show_help && help_.is_open();
    if (action && (!typing || closes_help || *action == Action::quit)) act(*action);
  }
}

// Closes the topmost list or dialog; without one it frees probe and fixation.
void Viewer::escape() {
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId)) return close_top_popup();
  view_.pinned.reset();
  view_.measured.reset();
  view_.lock.unlock();
}

// While the probe is pinned the arrow keys move it, with Shift by ten pixels.
bool Viewer::move_pin(const Window::KeyPress& press) {
  if (!view_.pinned || !view_.result || press.ctrl) return false;
  const int step = press.shift ? 10 : 1;
  cv::Point by;
  switch (press.key) {
    case Key::left:
      by.x = -step;
      break;
    case Key::right:
      by.x = step;
      break;
    case Key::up:
      by.y = -step;
      break;
    case Key::down:
      by.y = step;
      break;
    default:
      return false;
  }
  view_.lock.unlock();
  const cv::Size size = view_.result->frame().size();
  view_.pinned = cv::Point(std::clamp(view_.pinned->x + by.x, 0, size.width - 1),
                           std::clamp(view_.pinned->y + by.y, 0, size.height - 1));
  return true;
}

void Viewer::act(Action action) {
  if (act_on_playback(action) || act_on_tuning(action) || act_on_picture(action)) return;
  act_on_window(action);
}

bool Viewer::act_on_playback(Action action) {
  constexpr std::int64_t kJump = 10, kEnd = std::int64_t{1} << 40;
  PlaybackControls& playback = session_->playback();
  const PlaybackState now = playback.state();
  switch (action) {
    case Action::play_pause:
      playback.toggle();
      return true;
    case Action::previous_frame:
      playback.step(-1);
      return true;
    case Action::next_frame:
      playback.step(1);
      return true;
    case Action::back_10:
      playback.step(-kJump);
      return true;
    case Action::forward_10:
      playback.step(kJump);
      return true;
    case Action::first_frame:
      playback.seek(0);
      return true;
    case Action::last_frame:
      playback.seek(view_.source.source.frame_count.value_or(kEnd) - 1);
      return true;
    case Action::slower:
      playback.set_speed(next_speed(now.speed, -1));
      return true;
    case Action::faster:
      playback.set_speed(next_speed(now.speed, 1));
      return true;
    case Action::toggle_loop:
      playback.set_loop(!now.loop);
      return true;
    case Action::mark_in:
      playback.set_in(marked(now.in, now.position));
      return true;
    case Action::mark_out:
      playback.set_out(marked(now.out, now.position));
      return true;
    default:
      return false;
  }
}

bool Viewer::act_on_tuning(Action action) {
  Settings& s = state_.edited();
  switch (action) {
    case Action::kernel_down:
      s.kernel = next_kernel(s.kernel, -1);
      return true;
    case Action::kernel_up:
      s.kernel = next_kernel(s.kernel, 1);
      return true;
    case Action::next_model:
      next_model(s, 1);
      return true;
    case Action::previous_model:
      next_model(s, -1);
      return true;
    case Action::next_selector:
      s.selector = s.selector == Selector::proto ? Selector::wta : Selector::proto;
      return true;
    case Action::undo:
    case Action::redo:
      history_.change(state_.settings);
      action == Action::undo ? history_.undo() : history_.redo();
      state_.settings = history_.now();
      return true;
    case Action::swap_sides:
      swap_sides(state_.settings);
      return true;
    case Action::copy_command:
      copy_command();
      return true;
    case Action::save_settings:
      settings_dialog_.show();
      return true;
    default:
      return false;
  }
}

bool Viewer::act_on_picture(Action action) {
  OverlayStyle& style = state_.style;
  const auto next = [](auto value, int count) {
    return static_cast<decltype(value)>((static_cast<int>(value) + 1) % count);
  };
  switch (action) {
    case Action::toggle_background:
      style.background = next(style.background, 2);
      return true;
    case Action::toggle_map:
      state_.show_map = !state_.show_map;
      return true;
    case Action::toggle_marks:
      style.marks = !style.marks;
      return true;
    case Action::toggle_path:
      style.path = !style.path;
      return true;
    case Action::toggle_outlines:
      style.outlines = !style.outlines;
      return true;
    case Action::next_palette:
      next_palette(style.map);
      return true;
    case Action::fit_picture:
      picture_.fit();
      return true;
    case Action::next_comparison:
      state_.comparison = next(state_.comparison, 4);
      return true;
    case Action::next_centre:
      state_.centre = next(state_.centre, 3);
      return true;
    default:
      return false;
  }
}

void Viewer::act_on_window(Action action) {
  switch (action) {
    case Action::toggle_sidebar:
      state_.sidebar = !state_.sidebar;
      break;
    case Action::toggle_theme:
      state_.theme = state_.theme == Theme::dark ? Theme::light : Theme::dark;
      break;
    case Action::open_source:
      open_dialog_.show();
      break;
    case Action::paste_source:
      paste_source();
      break;
    case Action::snapshot:
      sidebar_.sensors().snapshot(view_);
      break;
    case Action::record:
      sidebar_.sensors().toggle_recording(view_);
      break;
    case Action::show_help:
      help_.toggle();
      break;
    case Action::quit:
      window_.close();
      break;
    default:
      break;
  }
}

// Of the marked part of a recording, else of the frame on screen. While comparing: a line for each side.
void Viewer::copy_command() {
  std::optional<PlayRange> frames;
  const PlaybackState& playing = view_.playback;
  if (!view_.source.source.live && (playing.in || playing.out)) {
    const std::int64_t start = playing.in.value_or(0);
    frames = PlayRange{start, 1, playing.out ? *playing.out - start + 1 : 0};
  } else if (!view_.source.source.live && view_.result) {
    frames = PlayRange{view_.result->frame().index, 1, 1};
  }
  const std::string program = program_word();
  const auto line = [&](Settings settings) {
    settings.overlay = shown_style(state_);
    return run_command_line(program, view_.source.uri, settings, frames);
  };
  std::string text = line(state_.settings.a);
  if (state_.comparing()) text += "\n" + line(state_.settings.b);
  ImGui::SetClipboardText(text.c_str());
  view_.notify("Copied: " + text);
}

void Viewer::paste_source() {
  const char* text = ImGui::GetClipboardText();
  const std::string source = typed_path(text == nullptr ? "" : text);
  if (source.empty()) return view_.notify("There is no path in the clipboard");
  open(source);
}

}  // namespace saccade
