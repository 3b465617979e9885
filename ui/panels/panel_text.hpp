#pragma once

#include <string>

#include <imgui.h>

namespace saccade {

/// The meaning of a text's colour.
enum class Tone { plain, quiet, good, warning, bad };

/// The place of something on the screen.
struct ItemPlace {
  std::string name;
  ImVec2 low, high;
};
[[nodiscard]] ItemPlace place_of_item(const std::string& name);  ///< of the last item

/// Readable on the background of the present style, dark or light.
[[nodiscard]] ImVec4 tone_colour(Tone tone);

/// Distinct colours for pyramid levels and stages of the computation, the same in every panel.
[[nodiscard]] ImU32 series_colour(int index);

/// Plain text, wrapped at the right edge of the window.
void wrapped_text(const std::string& text, Tone tone = Tone::plain);

/// A cell of a table, right-aligned, for numbers.
void number_cell(const std::string& text, Tone tone = Tone::plain);

/// A row of a table of two columns: a quiet label and its value.
void labelled_row(const char* label, const std::string& value, Tone tone = Tone::plain);

/// Begins a table of labelled_row()s whose labels are as wide as `widest_label`. If true, rows and
/// ImGui::EndTable() must follow.
[[nodiscard]] bool begin_labelled_rows(const char* id, const char* widest_label);

/// A small square in a colour, as high as the text; the next item follows on the same line.
void swatch(ImU32 colour);

/// Begins a row of controls: its name at the left; the next widget fills the rest.
void named_row(const char* name, const char* explanation = "");

/// The tool tip of the last item; an empty text does nothing.
void explain(const std::string& text);

}  // namespace saccade
