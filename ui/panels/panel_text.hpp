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

/// A value >= 0 of a saliency map, with the same digits everywhere: "1.35", "0.002", "0".
[[nodiscard]] std::string saliency_text(float saliency);

/// Plain text, wrapped at the right edge of the window.
void wrapped_text(const std::string& text, Tone tone = Tone::plain);

/// A cell of a table, right-aligned, for numbers.
void number_cell(const std::string& text, Tone tone = Tone::plain);

/// A row of a table of two columns: a quiet label and its value. The explanation is the tool tip of the
/// label.
void labelled_row(const char* label, const std::string& value, Tone tone = Tone::plain,
                  const std::string& explanation = "");

/// Begins a table of labelled_row()s whose labels are as wide as `widest_label`. If true, rows and
/// ImGui::EndTable() must follow.
[[nodiscard]] bool begin_labelled_rows(const char* id, const char* widest_label);

/// A small square in a colour, as high as the text; the next item follows on the same line.
void swatch(ImU32 colour);

/// A tool tip with this text, wrapped, at the mouse.
void show_tool_tip(const std::string& text);

/// The tool tip of the last item; an empty text does nothing.
void explain(const std::string& text);

/// Begins a row of controls: its name at the left; the next widget fills the rest.
void begin_named_row(const char* name, const std::string& explanation);

/// A row: its name at the left, and the widget that `draw` makes in the rest; both have the explanation as
/// tool tip. Returns what `draw` does.
template <typename Draw>
bool named_row(const char* name, const std::string& explanation, Draw draw) {
  begin_named_row(name, explanation);
  const bool changed = draw();
  explain(explanation);
  return changed;
}

}  // namespace saccade
