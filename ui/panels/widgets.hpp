#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "ui/panels/panel_text.hpp"
#include "ui/panels/view_context.hpp"
#include "ui/session/overlay_shapes.hpp"

namespace saccade {

/// Icons, drawn as shapes, so that they need no font.
enum class Icon { play, pause, step_back, step_forward, loop, first, last, record, camera };

/// A square button; `lit` marks one that is switched on.
bool icon_button(ViewContext& view, const char* id, Icon icon, bool lit, const std::string& tip);

/// Begins a modal window in the middle, after `opening` was set, which this clears; at most `width` pixels of
/// a screen of usual density wide. If true, ImGui::EndPopup() must follow.
[[nodiscard]] bool begin_dialog(ViewContext& view, const char* title, bool& opening, double width);

/// Closes the topmost drop-down list or dialog, if one is open. Between windows, before they are drawn.
void close_top_popup();

/// The last part of a path; other sources stay as they are.
[[nodiscard]] std::string short_name(const std::string& uri);

/// A row of exclusive choices, one item to explain(); true if `chosen` changed.
bool segments(ViewContext& view, const char* id, const std::vector<std::string>& names, int& chosen);

/// A combo box over words; true if `word` changed. `help` gives the tool tip of a word; may be null.
bool word_combo(const char* id, const std::vector<std::string>& words, std::string& word,
                std::string (*help)(const std::string& word) = nullptr);

/// A line of text in the present colour, at most `width` pixels wide: a longer one ends with "…".
void clipped_text(const std::string& text, float width);

/// At most `most` bytes of a UTF-8 text, with "…" in place of its middle if it is longer.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most);

/// Sets the text of an input field, cut to its size.
void set_text(std::span<char> field, const std::string& text);

/// A text for explain() with the keys of an action: "Play (Space)".
[[nodiscard]] std::string with_key(const std::string& text, Action action);

/// Puts the place of the last item, or `place`, into the window's log.
void log_place(ViewContext& view, const char* name);
void log_place(ViewContext& view, const ItemPlace& place);

/// As ImGui's OpenGL backend takes it.
inline ImTextureID as_imgui(TextureId id) {
  return reinterpret_cast<ImTextureID>(id);  // NOLINT(performance-no-int-to-ptr)
}

inline unsigned as_u32(Rgba c) { return IM_COL32(c.r, c.g, c.b, c.a); }
inline ImVec2 as_imvec(cv::Point2d p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }
inline cv::Point2d as_point(ImVec2 p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

}  // namespace saccade
