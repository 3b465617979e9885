#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace saccade {

// clang-format off
/// Everything that a key or a button can do.
enum class Action {
  play_pause, previous_frame, next_frame, back_10, forward_10, first_frame, last_frame, slower, faster, toggle_loop,
  mark_in, mark_out,
  kernel_down, kernel_up, next_model, previous_model, next_selector, undo, redo, copy_command,
  toggle_map, toggle_marks, toggle_path, toggle_outlines, toggle_background, next_palette, fit_picture,
  next_comparison, swap_sides, next_centre, toggle_sidebar, toggle_theme, open_source, paste_source,
  save_settings, snapshot, record, show_help, quit,
};
// clang-format on

/// Keys without a character; a character is its own upper-case code.
enum class Key : int { left = 0x100, right, up, down, home, end, f1, escape, space = ' ' };
constexpr Key key_of(char character) { return static_cast<Key>(character); }

struct Shortcut {
  Action action;
  Key key;
  bool ctrl = false, shift = false;
  std::string_view group;  ///< heading in the help
  std::string_view text;   ///< description in the help
};

/// All shortcuts, in the order of the help; an action may have several.
[[nodiscard]] std::span<const Shortcut> shortcuts();

/// The action of a key; none if it has none.
[[nodiscard]] std::optional<Action> action_of(Key key, bool ctrl, bool shift);

/// "Ctrl+Shift+Z".
[[nodiscard]] std::string key_name(const Shortcut& shortcut);

/// The name of the first key of an action, for tool tips; empty if it has none.
[[nodiscard]] std::string key_name(Action action);

}  // namespace saccade
