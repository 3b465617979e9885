#include <algorithm>
#include <array>
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
  names.reserve(std::size(kPalettes));
  for (const Palette p : kPalettes) names.emplace_back(to_string(p));
  std::string name(to_string(palette));
  if (!word_combo(id, names, name)) return false;
  palette = palette_named(name).value_or(palette);
  return true;
}

bool percent_slider(const char* id, double& percent, float largest) {
  auto shown = static_cast<float>(percent);
  if (!ImGui::SliderFloat(id, &shown, 0, largest, "%.0f %%", ImGuiSliderFlags_AlwaysClamp)) return false;
  percent = static_cast<double>(shown);
  return true;
}

bool share_slider(const char* id, double& share) {
  double percent = 100 * share;
  if (!percent_slider(id, percent, 100)) return false;
  share = percent / 100;
  return true;
}

// An automatic range that can be locked at its present values and then be changed.
void draw_range(ViewContext& view, const char* id, std::optional<ValueRange>& range, ValueRange automatic,
                float step, const char* format) {
  ImGui::PushID(id);
  bool locked = range.has_value();
  if (ImGui::Checkbox("Lock range", &locked)) range = locked ? std::optional(automatic) : std::nullopt;
  log_place(view, (std::string("lock ") + id).c_str());
  explain(
      "Keeps the range of the map's local mean, or of depth, from frame to frame, so that colours can be "
      "compared");
  if (range) {
    ImGui::SameLine(view.px(112) + ImGui::GetStyle().WindowPadding.x);
    ImGui::SetNextItemWidth(-1);
    ImGui::DragFloatRange2("##range", &range->low, &range->high, step, 0, 1e5F, format, format);
    explain("The values at both ends of the colours. Drag, or Ctrl+click to type");
    if (!(range->high > range->low)) range->high = range->low + step;
  }
  ImGui::PopID();
}

// How many pixels have which depth, with the range of the colours.
void draw_depths(ViewContext& view, ValueRange range) {
  constexpr std::size_t kBins = 64;
  constexpr int kEvery = 5;  // rows and columns of the sample
  const cv::Mat1f& depth = view.result->frame().depth_mm;
  double farthest = 0;
  cv::minMaxLoc(depth, nullptr, &farthest);
  if (!(farthest > 0)) return wrapped_text("This frame has no depth.", Tone::quiet);
  std::array<float, kBins> bins{};
  float nearest = static_cast<float>(farthest);
  for (int r = 0; r < depth.rows; r += kEvery)
    for (int c = 0; c < depth.cols; c += kEvery) {
      const float z = depth(r, c);
      if (!(z > 0)) continue;
      nearest = std::min(nearest, z);
      const auto bin = static_cast<std::size_t>(kBins * static_cast<double>(z) / (farthest + 1));
      bins[std::min(bin, kBins - 1)] += 1;
    }
  const std::string text = fmt::format("{:.0f} .. {:.0f} mm", nearest, farthest);
  ImGui::PlotHistogram("##depths", bins.data(), static_cast<int>(kBins), 0, text.c_str(), 0,
                       *std::ranges::max_element(bins), {ImGui::GetContentRegionAvail().x, view.px(56)});
  explain(
      "How often each depth occurs, from 0 to the largest reading, with its smallest and largest. The lines "
      "are the range of the colours");
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  for (const float end : {range.low, range.high}) {
    const float x = low.x + (high.x - low.x) * std::min(1.0F, end / static_cast<float>(farthest));
    ImGui::GetWindowDrawList()->AddLine({x, low.y}, {x, high.y}, view.colours->accent, view.px(1.5));
  }
}

void draw_text_size(ViewContext& view) {
  const double now = view.state.ui_scale;
  const auto name = [](double scale) {
    return scale > 0 ? fmt::format("{:.0f} %", 100 * scale) : "automatic";
  };
  named_row("Text size", "Of text and controls; automatic = as the screen reports", [&] {
    if (!ImGui::BeginCombo("##text_size", name(now).c_str())) return false;
    for (const double scale : {0.0, 0.75, 0.9, 1.0, 1.15, 1.3, 1.5, 1.75, 2.0})
      if (ImGui::Selectable(name(scale).c_str(), scale == now)) view.state.ui_scale = scale;
    ImGui::EndCombo();
    return true;
  });
}

}  // namespace

void draw_display_panel(ViewContext& view) {
  OverlayStyle& style = view.state.style;
  int background = static_cast<int>(style.background);
  if (named_row("Background",
                with_key("The picture below the map: the colour image, or depth in colours",
                         Action::toggle_background),
                [&] {
                  return segments(view, "background", {"colour", "depth"}, background);
                }))
    style.background = static_cast<Background>(background);
  if (style.background == Background::depth) {
    named_row("Depth colours", "Near is the bright end; black has no reading",
              [&] { return palette_combo("##depth_palette", style.depth.palette); });
    const auto automatic =
        view.result ? shown_range(view.result->frame().depth_mm, {.percentile = style.depth.percentile})
                    : std::nullopt;
    const ValueRange range = automatic.value_or(ValueRange{500, 4000});
    if (view.result) draw_depths(view, style.depth.range_mm.value_or(range));
    draw_range(view, "depth", style.depth.range_mm, range, 10, "%.0f mm");
    if (!style.depth.range_mm) {
      named_row("Left out", "Share of the depths beyond each end of the automatic range, in percent",
                [&] { return percent_slider("##depth_percentile", style.depth.percentile, 25); });
    }
  }
  ImGui::Spacing();
  ImGui::Checkbox("Saliency map", &view.state.show_map);
  explain(with_key("Shows the saliency map over the picture", Action::toggle_map));
  if (view.state.show_map) {
    named_row(
        "Map colours",
        with_key("turbo is a perceptually even rainbow; viridis and inferno also grow evenly in lightness",
                 Action::next_palette),
        [&] { return palette_combo("##palette", style.map.palette); });
    named_row("Opacity", "Of the most salient pixel; less salient pixels are more transparent",
              [&] { return share_slider("##opacity", style.map.opacity); });
    named_row("Threshold", "Hides values below this share of the range",
              [&] { return share_slider("##threshold", style.map.threshold); });
    const ValueRange automatic =  // as in the legend
        view.result ? shown_range(view.result->a.smooth, shown_map_style(view.state, *view.result))
                    : ValueRange{0, 1};
    if (view.state.comparing()) {
      ImGui::Checkbox("A and B on one range", &view.state.common_range);
      explain(
          "The same colour is the same value in both maps; applies where both are of one model and no range "
          "is locked");
    }
    draw_range(view, "map", style.map.range, automatic, 0.01F, "%.2f");
  }
  ImGui::Spacing();
  ImGui::Checkbox("Fixations", &style.marks);
  explain(with_key(
      "Numbered marks at the fixations; over time each object has its colour, else the first is green",
      Action::toggle_marks));
  ImGui::SameLine(0, view.px(14));
  ImGui::Checkbox("Scan path", &style.path);
  explain(with_key("Lines from each fixation to the next; over time, where the gaze was before",
                   Action::toggle_path));
  ImGui::SameLine(0, view.px(14));
  ImGui::Checkbox("Outlines", &style.outlines);
  explain(with_key("Outlines of the proto-objects", Action::toggle_outlines));
  draw_text_size(view);
}

}  // namespace saccade
