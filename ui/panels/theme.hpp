#pragma once

#include <opencv2/core.hpp>

#include "ui/session/view_state.hpp"

struct ImFont;
struct ImVec4;

namespace saccade {

/// Colours that ImGui's own style has no place for, 0xAABBGGRR as ImGui draws them.
struct ThemeColours {
  unsigned text, dim_text, accent, warning, error, error_back, panel, line, plot, plot_old, on_picture, chip;
  cv::Scalar behind;  ///< of the window, 0..1
};

const ThemeColours& colours_of(Theme theme);

/// Sets ImGui's style for a theme and a scale.
void apply_theme(Theme theme, double scale);

/// Besides the usual font.
struct Fonts {
  ImFont *bold = nullptr, *large = nullptr;
};

/// Makes the font atlas for a scale: a system font, or ImGui's own where none is found.
Fonts load_fonts(double scale);

/// A theme's colour as ImGui's styles want it.
ImVec4 as_vec4(unsigned colour);

}  // namespace saccade
