#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "models/model.hpp"
#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"
#include "ui/session/command_line.hpp"

namespace saccade {
namespace {

std::string help_of_model(const std::string& name) {
  for (const ModelInfo& model : models())
    if (model.name == name)
      return std::string(model.help) + (model.needs_depth ? ". Needs depth" : ". Works on the colour image");
  return "";
}

// A row for a setting of words; the values of `Enum` are in their order.
template <typename Enum>
void choice_row(ViewContext& view, const char* key, const char* name, const char* explanation, Enum& value) {
  int chosen = static_cast<int>(value);
  if (named_row(name, explanation, [&] { return segments(view, key, choices_of(key), chosen); }))
    value = static_cast<Enum>(chosen);
}

void draw_kernel(ViewContext& view, Settings& s) {
  const std::string explanation = fmt::format(
      "Side of the operator's window around each pixel, at every pyramid level. Drag, or Ctrl+click to "
      "type a size. Keys: {} is smaller, {} is larger",
      key_name(Action::kernel_down), key_name(Action::kernel_up));
  if (named_row("Kernel", explanation, [&] {
        return ImGui::SliderInt("##kernel", &s.kernel, 3, 127, "%d px", ImGuiSliderFlags_AlwaysClamp);
      }))
    s.kernel = std::clamp(s.kernel | 1, 3, 127);  // the window is odd
  log_place(view, "kernel");
}

void draw_levels(ViewContext& view, Settings& s) {
  // Shows the default levels as they are used, cut to those that the frame has room for.
  const Computed* shown = view.result ? &view.result->a : nullptr;
  int first = s.first_level, last = s.last_level;
  if (!s.levels_chosen && shown != nullptr) last = std::min(last, shown->settings.last_level);
  const char* explanation =
      "The pyramid levels whose maps are added. Level 0 has full size, each further one half the size of the "
      "one before. Drag, or Ctrl+click to type";
  if (named_row("Levels", explanation, [&] {
        return ImGui::DragIntRange2("##levels", &first, &last, 0.05F, 0, 8, "from %d", "to %d",
                                    ImGuiSliderFlags_AlwaysClamp);
      })) {
    s.first_level = first;
    s.last_level = last;
    s.levels_chosen = true;
  }
}

void draw_operator(ViewContext& view, Settings& s) {
  ImGui::BeginDisabled(!needs_depth(s.model));
  draw_kernel(view, s);
  draw_levels(view, s);
  choice_row(
      view, "length-scale", "Length scale",
      "Unit in which the distances of point pairs are weighed. relative: 5 % of the window's width on the "
      "surface, so that an object gives the same value near and far; millimetre: as in the paper",
      s.length_scale);
  choice_row(
      view, "normalisation", "Normalise",
      "Weighs the map of each level before they are added. none: as they are; max: by the largest value; "
      "itti: maps with few strong peaks count more than maps with many equal ones",
      s.normalisation);
  ImGui::EndDisabled();
}

void draw_attention(ViewContext& view, Settings& s) {
  choice_row(
      view, "selector", "Selector",
      "How fixations are chosen in the map. proto: one for each proto-object, a surface that stands out as "
      "one thing; wta: the paper's winner-take-all network, with inhibition of return",
      s.selector);
  named_row("Fixations", "Fixations per frame, at most",
            [&] { return ImGui::SliderInt("##fixations", &s.fixations, 1, 30, "%d"); });
  s.fixations = std::clamp(s.fixations, 1, 1000);
  if (s.selector == Selector::proto) {
    auto least = static_cast<float>(s.min_confidence);
    // Rounded as shown: a setting of 0.30000001 would be odd in a file.
    if (named_row("Confidence",
                  "Fixations that are less certain to lie on an object are not shown; 0 shows all", [&] {
                    return ImGui::SliderFloat("##confidence", &least, 0, 1, "at least %.2f",
                                              ImGuiSliderFlags_AlwaysClamp);
                  }))
      s.min_confidence = std::round(100 * static_cast<double>(least)) / 100;
    log_place(view, "confidence");
    return;
  }
  auto foa = static_cast<float>(s.foa);
  if (named_row("Focus", "Diameter of the focus of attention: what is inhibited around a fixation, in pixels",
                [&] { return ImGui::SliderFloat("##foa", &foa, 8, 256, "%.0f px"); }))
    s.foa = std::clamp(static_cast<double>(foa), 1.0, 1000.0);
}

void draw_seconds(const char* name, const std::string& explanation, double most, double& seconds) {
  auto value = static_cast<float>(seconds);
  ImGui::PushID(name);
  if (named_row(name, explanation, [&] {
        return ImGui::SliderFloat("##seconds", &value, 0, static_cast<float>(most), "%.1f s",
                                  ImGuiSliderFlags_AlwaysClamp);
      }))
    seconds = std::round(10 * static_cast<double>(value)) / 10;
  ImGui::PopID();
}

// Shared by both sides of a comparison.
void draw_over_time(ViewContext& view) {
  Settings& s = view.state.settings.a;
  ImGui::BeginDisabled(view.state.edited().selector != Selector::proto);
  choice_row(
      view, "tracking", "Tracking",
      "Attention over time: objects keep their numbers and colours while the camera moves, and a gaze goes "
      "from one to the next. auto: for sensors, recordings and videos",
      s.tracking);
  if (s.tracking != Tracking::off) {
    const bool stills = s.tracking == Tracking::automatic && view.source.phase == SessionState::Phase::open &&
                        !view.source.source.sequence;
    const auto explained = [&](const std::string& text) {
      return stills ? text + ". These images are no sequence: nothing is tracked unless Tracking is on"
                    : text;
    };
    ImGui::BeginDisabled(stills);
    draw_seconds("Dwell", explained("How long the gaze rests on one object"), 5, s.dwell_s);
    log_place(view, "dwell");
    draw_seconds("Return after", explained("How long after it has left an object the gaze may return to it"),
                 30, s.return_after_s);
    draw_seconds("Memory", explained("How long an object out of sight is remembered"), 120, s.memory_s);
    ImGui::EndDisabled();
  }
  ImGui::EndDisabled();
}

void draw_tuning_buttons(ViewContext& view) {
  ImGui::BeginDisabled(!view.can_undo);
  if (ImGui::Button("Undo")) view.act(Action::undo);
  log_place(view, "undo");
  ImGui::EndDisabled();
  explain(with_key("Undo a change of settings", Action::undo));
  ImGui::SameLine();
  ImGui::BeginDisabled(!view.can_redo);
  if (ImGui::Button("Redo")) view.act(Action::redo);
  log_place(view, "redo");
  ImGui::EndDisabled();
  explain(with_key("Redo a change of settings", Action::redo));
  ImGui::SameLine();
  if (ImGui::Button("Reset")) copy_compared(Settings{}, view.state.edited());
  explain("Restores the default settings; can be undone");
  ImGui::SameLine();
  if (ImGui::Button("File…")) view.act(Action::save_settings);
  explain(with_key("Save or load settings as TOML", Action::save_settings));
  if (ImGui::Button("Copy command line")) view.act(Action::copy_command);
  explain(with_key("Copies the saccade run command that computes this result without a window",
                   Action::copy_command));
  log_place(view, "copy");
}

}  // namespace

void draw_tuning_panel(ViewContext& view) {
  if (view.state.comparing()) {
    int side = view.state.edit_b ? 1 : 0;
    if (named_row("Settings of", "The side of the comparison that this panel edits", [&] {
          return segments(view, "side", {"  A  ", "  B  "}, side);
        }))
      view.state.edit_b = side == 1;
    ImGui::SameLine(0, view.px(10));
    if (ImGui::Button("Swap")) view.act(Action::swap_sides);
    explain(with_key("Swap A and B", Action::swap_sides));
  }
  Settings& s = view.state.edited();
  named_row(
      "Model",
      with_key("How the saliency of each pixel is computed. " + help_of_model(s.model), Action::next_model),
      [&] { return word_combo("##model", choices_of("model"), s.model, help_of_model); });
  log_place(view, "model");
  draw_operator(view, s);
  draw_attention(view, s);
  draw_over_time(view);
  ImGui::Dummy({0, view.px(2)});
  draw_tuning_buttons(view);
}

}  // namespace saccade
