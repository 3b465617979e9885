#pragma once

#include <opencv2/core.hpp>

#include "ui/session/view_state.hpp"

struct ImFont;
struct ImVec4;

namespace saccade {

/// Colours besides those of ImGui's style, 0xAABBGGRR as ImGui draws them.
struct ThemeColours {
  unsigned text, dim_text, accent, warning, error, error_back, panel, line, plot, plot_old, on_picture, chip;
  cv::Scalar behind;  ///< everything, red, green, blue, 0..1
};

const ThemeColours& colours_of(Theme theme);

/// Sets ImGui's style for a theme and a scale.
void apply_theme(Theme theme, double scale);

/// Besides the default font.
struct Fonts {
  ImFont *bold = nullptr, *large = nullptr;
};

/// Builds the font atlas for a scale: from a system font, or ImGui's own where none is found.
Fonts load_fonts(double scale);

/// A theme's colour in the form of ImGui's styles.
[[nodiscard]] ImVec4 as_vec4(unsigned colour);

}  // namespace saccade
