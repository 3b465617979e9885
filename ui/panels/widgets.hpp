#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "ui/panels/panel_text.hpp"
#include "ui/panels/view_context.hpp"
#include "ui/session/overlay_shapes.hpp"

namespace saccade {

/// Icons that are drawn, so that no font has to have them.
enum class Icon { play, pause, step_back, step_on, loop, first, last, record, camera };

/// A square button of one frame's height; `lit` marks one that is switched on.
bool icon_button(ViewContext& view, const char* id, Icon icon, bool lit, const std::string& tip);

/// A row of exclusive choices; returns true if `chosen` changed.
bool segments(ViewContext& view, const char* id, const std::vector<std::string>& names, int& chosen);

/// A combo box over words; true if `word` changed.
bool word_combo(const char* id, const std::vector<std::string>& words, std::string& word);

/// A text for explain() with the key of an action.
std::string with_key(const std::string& text, Action action);

/// Remembers where the item before is.
void note_place(ViewContext& view, const char* name);
void note_place(ViewContext& view, const ItemPlace& place);

/// As ImGui's OpenGL backend takes it.
inline ImTextureID as_imgui(TextureId id) {
  return reinterpret_cast<ImTextureID>(id);  // NOLINT(performance-no-int-to-ptr)
}

inline unsigned as_u32(Rgba c) { return IM_COL32(c.r, c.g, c.b, c.a); }
inline ImVec2 as_imvec(cv::Point2d p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }
inline cv::Point2d as_point(ImVec2 p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

}  // namespace saccade
