#include "ui/panels/theme.hpp"

#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace saccade {
namespace {

constexpr double kFontSize_px = 15, kLargeFontSize_px = 24;

struct FontFiles {
  const char *regular, *bold;
};
constexpr std::array kFonts = {
    FontFiles{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
              "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"},
    FontFiles{"/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
              "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf"},
    FontFiles{"/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
              "/usr/share/fonts/truetype/liberation/LiberationSans-Bold.ttf"},
};
// Drawing the glyphs is a part of the start of the window, so there are no more than the texts need: Latin
// (names of files and sensors), dashes, quotes, ellipsis and minus; headlines are in English.
constexpr std::array<ImWchar, 7> kGlyphs = {0x20, 0x17f, 0x2010, 0x2027, 0x2212, 0x2212, 0};
constexpr std::array<ImWchar, 5> kHeadlineGlyphs = {0x20, 0x7e, 0x2026, 0x2026, 0};

constexpr unsigned rgb(unsigned hex, unsigned alpha = 255) {
  return alpha << 24 | (hex & 0xff) << 16 | (hex >> 8 & 0xff) << 8 | (hex >> 16 & 0xff);
}

const ThemeColours kDark = {.text = rgb(0xe4e7eb),
                            .dim_text = rgb(0x98a1ae),
                            .accent = rgb(0x4cb5f5),
                            .warning = rgb(0xf2b84b),
                            .error = rgb(0xff7a70),
                            .error_back = rgb(0x4a2226),
                            .panel = rgb(0x1d2127),
                            .line = rgb(0x343a43),
                            .plot = rgb(0x58c98b),
                            .plot_old = rgb(0x4a525d),
                            .on_picture = rgb(0xffffff),
                            .chip = rgb(0x0b0d10, 190),
                            .behind = {0.078, 0.090, 0.106}};
const ThemeColours kLight = {.text = rgb(0x1c2228),
                             .dim_text = rgb(0x5a6572),
                             .accent = rgb(0x0b72b9),
                             .warning = rgb(0x9a6200),
                             .error = rgb(0xb3261e),
                             .error_back = rgb(0xfbe3e1),
                             .panel = rgb(0xffffff),
                             .line = rgb(0xcfd5dc),
                             .plot = rgb(0x23854f),
                             .plot_old = rgb(0xb7bfc8),
                             .on_picture = rgb(0xffffff),
                             .chip = rgb(0x0b0d10, 190),
                             .behind = {0.925, 0.937, 0.949}};

struct Surface {
  unsigned window, frame, frame_hovered, frame_active, button, button_hovered, popup, grab, odd_row;
};
constexpr Surface kDarkSurface = {rgb(0x14171b), rgb(0x272c34), rgb(0x313842), rgb(0x3a4350), rgb(0x2b313a),
                                  rgb(0x38414d), rgb(0x20252c), rgb(0x2f7fb5), rgb(0x22272e)};
constexpr Surface kLightSurface = {rgb(0xeceff2), rgb(0xe3e7ec), rgb(0xd6dce3), rgb(0xc8d1da), rgb(0xe0e5ea),
                                   rgb(0xd0d8e0), rgb(0xffffff), rgb(0x8fc3e8), rgb(0xf3f5f7)};

}  // namespace

const ThemeColours& colours_of(Theme theme) { return theme == Theme::dark ? kDark : kLight; }

ImVec4 as_vec4(unsigned colour) { return ImGui::ColorConvertU32ToFloat4(colour); }

void apply_theme(Theme theme, double scale) {
  ImGuiStyle style;
  theme == Theme::dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
  style.WindowRounding = style.ChildRounding = 0;
  style.FrameRounding = style.GrabRounding = 5;
  style.PopupRounding = 8;
  style.ScrollbarRounding = 6;
  style.ScrollbarSize = 11;
  style.WindowPadding = {12, 10};
  style.FramePadding = {9, 5};
  style.ItemSpacing = {8, 7};
  style.ItemInnerSpacing = {7, 5};
  style.GrabMinSize = 14;
  style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = 0;
  style.PopupBorderSize = 1;
  style.DisabledAlpha = 0.45F;
  const ThemeColours& c = colours_of(theme);
  const Surface& s = theme == Theme::dark ? kDarkSurface : kLightSurface;
  const auto set = [&](int index, unsigned colour) { style.Colors[index] = as_vec4(colour); };
  const auto faint = [&](unsigned alpha) { return (c.accent & 0x00ffffff) | alpha << 24; };
  set(ImGuiCol_Text, c.text);
  set(ImGuiCol_TextDisabled, c.dim_text);
  set(ImGuiCol_WindowBg, s.window);
  set(ImGuiCol_ChildBg, 0);
  set(ImGuiCol_PopupBg, s.popup);
  set(ImGuiCol_Border, c.line);
  set(ImGuiCol_Separator, c.line);
  set(ImGuiCol_TitleBg, s.button);
  set(ImGuiCol_TitleBgActive, s.button);
  set(ImGuiCol_ResizeGrip, 0);
  set(ImGuiCol_FrameBg, s.frame);
  set(ImGuiCol_FrameBgHovered, s.frame_hovered);
  set(ImGuiCol_FrameBgActive, s.frame_active);
  set(ImGuiCol_Button, s.button);
  set(ImGuiCol_ButtonHovered, s.button_hovered);
  set(ImGuiCol_ButtonActive, s.frame_active);
  set(ImGuiCol_Header, s.button);
  set(ImGuiCol_HeaderHovered, s.button_hovered);
  set(ImGuiCol_HeaderActive, s.frame_active);
  set(ImGuiCol_Tab, s.button);
  set(ImGuiCol_TabHovered, s.button_hovered);
  set(ImGuiCol_TabActive, s.frame_active);
  set(ImGuiCol_SliderGrab, s.grab);  // the value is printed over it and must be readable
  set(ImGuiCol_SliderGrabActive, s.grab);
  set(ImGuiCol_CheckMark, c.accent);
  set(ImGuiCol_TextSelectedBg, faint(90));
  set(ImGuiCol_NavHighlight, c.accent);
  set(ImGuiCol_PlotLines, c.plot);
  set(ImGuiCol_PlotHistogram, c.plot);
  set(ImGuiCol_ScrollbarBg, 0);
  set(ImGuiCol_TableHeaderBg, s.frame);
  set(ImGuiCol_TableRowBg, 0);
  set(ImGuiCol_TableRowBgAlt, s.odd_row);
  set(ImGuiCol_TableBorderLight, c.line);
  set(ImGuiCol_TableBorderStrong, c.line);
  set(ImGuiCol_ModalWindowDimBg, rgb(0x000000, 110));
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle() = style;
}

Fonts load_fonts(double scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  const auto size = static_cast<float>(std::round(kFontSize_px * scale));
  const auto large = static_cast<float>(std::round(kLargeFontSize_px * scale));
  std::error_code code;
  for (const FontFiles& files : kFonts) {
    if (!std::filesystem::exists(files.regular, code) || !std::filesystem::exists(files.bold, code)) continue;
    ImFontConfig glyphs;
    glyphs.OversampleH = 2;  // looks like ImGui's 3, in two thirds of the time and memory
    atlas.AddFontFromFileTTF(files.regular, size, &glyphs, kGlyphs.data());
    return {atlas.AddFontFromFileTTF(files.bold, size, &glyphs, kGlyphs.data()),
            atlas.AddFontFromFileTTF(files.bold, large, &glyphs, kHeadlineGlyphs.data())};
  }
  ImFontConfig config;
  config.SizePixels = static_cast<float>(std::round(13 * scale));
  ImFont* const usual = atlas.AddFontDefault(&config);
  config.SizePixels = static_cast<float>(std::round(2 * 13 * scale));
  return {usual, atlas.AddFontDefault(&config)};
}

}  // namespace saccade
