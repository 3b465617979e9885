#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

bool palette_combo(const char* id, Palette& palette) {
  std::vector<std::string> names;
  for (const Palette p : kPalettes) names.emplace_back(to_string(p));
  std::string name(to_string(palette));
  if (!word_combo(id, names, name)) return false;
  palette = palette_named(name).value_or(palette);
  return true;
}

bool share_slider(const char* id, double& share) {
  auto percent = static_cast<float>(100 * share);
  if (!ImGui::SliderFloat(id, &percent, 0, 100, "%.0f %%", ImGuiSliderFlags_AlwaysClamp)) return false;
  share = static_cast<double>(percent) / 100;
  return true;
}

// An automatic range that can be locked at its present values and then be changed.
void draw_range(ViewContext& view, const char* id, std::optional<ValueRange>& range, ValueRange automatic,
                float step, const char* format) {
  ImGui::PushID(id);
  bool locked = range.has_value();
  if (ImGui::Checkbox("Lock range", &locked)) range = locked ? std::optional(automatic) : std::nullopt;
  explain("Keeps the range from frame to frame, so that colours can be compared");
  if (range) {
    ImGui::SameLine(view.px(112) + ImGui::GetStyle().WindowPadding.x);
    ImGui::SetNextItemWidth(-1);
    ImGui::DragFloatRange2("##range", &range->low, &range->high, step, 0, 1e5F, format, format);
    if (!(range->high > range->low)) range->high = range->low + step;
  }
  ImGui::PopID();
}

}  // namespace

void draw_display_panel(ViewContext& view) {
  OverlayStyle& style = view.state.style;
  named_row("Background");
  int background = static_cast<int>(style.background);
  if (segments(view, "background", {"colour", "depth"}, background))
    style.background = static_cast<Background>(background);
  if (style.background == Background::depth) {
    named_row("Depth colours");
    palette_combo("##depth_palette", style.depth.palette);
    const auto automatic = view.result ? percentile_range(view.result->frame().depth_mm, 100) : std::nullopt;
    draw_range(view, "depth", style.depth.range_mm, automatic.value_or(ValueRange{500, 4000}), 10, "%.0f mm");
  }
  ImGui::Spacing();
  ImGui::Checkbox("Saliency map", &view.state.show_map);
  explain(with_key("Shows the saliency map over the picture", Action::toggle_map));
  if (view.state.show_map) {
    named_row("Map colours");
    palette_combo("##palette", style.map.palette);
    named_row("Opacity", "Of the most salient pixel; less salient pixels are more transparent");
    share_slider("##opacity", style.map.opacity);
    named_row("Threshold", "Hides values below this share of the range");
    share_slider("##threshold", style.map.threshold);
    const ValueRange automatic =
        view.result ? shown_range(view.result->a.smooth, MapStyle{}) : ValueRange{0, 1};
    draw_range(view, "map", style.map.range, automatic, 0.01F, "%.2f");
  }
  ImGui::Spacing();
  ImGui::Checkbox("Fixations", &style.marks);
  explain(with_key("Numbered marks at the fixations, the first in green", Action::toggle_marks));
  ImGui::SameLine(0, view.px(14));
  ImGui::Checkbox("Scan path", &style.path);
  explain(with_key("Lines from each fixation to the next", Action::toggle_path));
  ImGui::SameLine(0, view.px(14));
  ImGui::Checkbox("Outlines", &style.outlines);
  explain(with_key("Outlines of the proto-objects", Action::toggle_outlines));
}

}  // namespace saccade
