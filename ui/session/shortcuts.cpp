#include "ui/session/shortcuts.hpp"

#include <algorithm>
#include <array>

namespace saccade {
namespace {

constexpr std::string_view kPlay = "Playing", kTune = "Tuning", kLook = "Picture", kGeneral = "General";

// clang-format off
constexpr std::array kShortcuts = {
    Shortcut{Action::play_pause, Key::space, false, false, kPlay, "Play or pause"},
    Shortcut{Action::previous_frame, Key::left, false, false, kPlay, "Previous frame"},
    Shortcut{Action::next_frame, Key::right, false, false, kPlay, "Next frame"},
    Shortcut{Action::back_10, Key::left, false, true, kPlay, "10 frames back"},
    Shortcut{Action::forward_10, Key::right, false, true, kPlay, "10 frames forward"},
    Shortcut{Action::first_frame, Key::home, false, false, kPlay, "First frame"},
    Shortcut{Action::last_frame, Key::end, false, false, kPlay, "Last frame"},
    Shortcut{Action::slower, key_of(','), false, false, kPlay, "Slower"},
    Shortcut{Action::faster, key_of('.'), false, false, kPlay, "Faster"},
    Shortcut{Action::toggle_loop, key_of('L'), false, false, kPlay, "Loop on or off"},
    Shortcut{Action::mark_in, key_of('I'), false, false, kPlay, "Play from this frame on"},
    Shortcut{Action::mark_out, key_of('I'), false, true, kPlay, "Play up to this frame"},

    Shortcut{Action::kernel_down, key_of('['), false, false, kTune, "Smaller kernel"},
    Shortcut{Action::kernel_down, key_of('-'), false, false, kTune, "Smaller kernel"},
    Shortcut{Action::kernel_up, key_of(']'), false, false, kTune, "Larger kernel"},
    Shortcut{Action::kernel_up, key_of('='), false, false, kTune, "Larger kernel"},
    Shortcut{Action::next_model, key_of('M'), false, false, kTune, "Next model"},
    Shortcut{Action::previous_model, key_of('M'), false, true, kTune, "Previous model"},
    Shortcut{Action::next_selector, key_of('W'), false, false, kTune, "Next selector"},
    Shortcut{Action::undo, key_of('Z'), true, false, kTune, "Undo a change of settings"},
    Shortcut{Action::redo, key_of('Z'), true, true, kTune, "Redo a change of settings"},
    Shortcut{Action::redo, key_of('Y'), true, false, kTune, "Redo a change of settings"},
    Shortcut{Action::copy_command, key_of('C'), true, true, kTune, "Copy as command line"},
    Shortcut{Action::save_settings, key_of('S'), true, false, kTune, "Save or load settings"},

    Shortcut{Action::toggle_background, key_of('D'), false, false, kLook, "Colour or depth image"},
    Shortcut{Action::toggle_map, key_of('A'), false, false, kLook, "Saliency map on or off"},
    Shortcut{Action::next_palette, key_of('P'), false, false, kLook, "Next colour map"},
    Shortcut{Action::toggle_marks, key_of('F'), false, false, kLook, "Fixations on or off"},
    Shortcut{Action::toggle_path, key_of('G'), false, false, kLook, "Scan path on or off"},
    Shortcut{Action::toggle_outlines, key_of('O'), false, false, kLook, "Outlines of proto-objects on or off"},
    Shortcut{Action::fit_picture, key_of('0'), false, false, kLook, "Fit picture"},
    Shortcut{Action::next_comparison, key_of('C'), false, false, kLook, "Next form of comparison"},
    Shortcut{Action::swap_sides, key_of('X'), false, false, kLook, "Swap A and B"},
    Shortcut{Action::next_centre, key_of('V'), false, false, kLook, "Picture, point cloud or both"},

    Shortcut{Action::open_source, key_of('O'), true, false, kGeneral, "Open a source"},
    Shortcut{Action::paste_source, key_of('V'), true, false, kGeneral, "Open the path in the clipboard"},
    Shortcut{Action::snapshot, key_of('S'), false, false, kGeneral, "Take a snapshot"},
    Shortcut{Action::record, key_of('R'), false, false, kGeneral, "Start or stop recording"},
    Shortcut{Action::toggle_sidebar, key_of('B'), false, false, kGeneral, "Side bar on or off"},
    Shortcut{Action::toggle_theme, key_of('T'), false, false, kGeneral, "Dark or light theme"},
    Shortcut{Action::show_help, key_of('?'), false, false, kGeneral, "Help: keys, mouse, glossary"},
    Shortcut{Action::show_help, Key::f1, false, false, kGeneral, "Help: keys, mouse, glossary"},
    Shortcut{Action::quit, key_of('Q'), true, false, kGeneral, "Quit"},
};
// clang-format on

std::string name_of(Key key) {
  switch (key) {
    case Key::left:
      return "Left";
    case Key::right:
      return "Right";
    case Key::up:
      return "Up";
    case Key::down:
      return "Down";
    case Key::home:
      return "Home";
    case Key::end:
      return "End";
    case Key::f1:
      return "F1";
    case Key::escape:
      return "Esc";
    case Key::space:
      return "Space";
  }
  if (key == key_of(',')) return "comma";
  if (key == key_of('.')) return "full stop";
  return {static_cast<char>(key)};
}

}  // namespace

std::span<const Shortcut> shortcuts() { return kShortcuts; }

std::optional<Action> action_of(Key key, bool ctrl, bool shift) {
  const auto found = std::find_if(kShortcuts.begin(), kShortcuts.end(), [&](const Shortcut& s) {
    return s.key == key && s.ctrl == ctrl && s.shift == shift;
  });
  if (found == kShortcuts.end()) return std::nullopt;
  return found->action;
}

std::string key_name(const Shortcut& shortcut) {
  return (shortcut.ctrl ? "Ctrl+" : "") + std::string(shortcut.shift ? "Shift+" : "") + name_of(shortcut.key);
}

std::string key_name(Action action) {
  for (const Shortcut& shortcut : kShortcuts)
    if (shortcut.action == action) return key_name(shortcut);
  return "";
}

}  // namespace saccade
