#include "ui/panels/panel_text.hpp"

#include <array>

#include <fmt/format.h>

namespace saccade {
namespace {

bool is_light() {
  const ImVec4& back = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  return 0.299F * back.x + 0.587F * back.y + 0.114F * back.z > 0.5F;
}

}  // namespace

ItemPlace place_of_item(const std::string& name) {
  return {name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
}

ImVec4 tone_colour(Tone tone) {
  const bool light = is_light();
  switch (tone) {
    case Tone::plain:
      return ImGui::GetStyle().Colors[ImGuiCol_Text];
    case Tone::quiet:
      return light ? ImVec4(0.36F, 0.38F, 0.42F, 1) : ImVec4(0.62F, 0.65F, 0.70F, 1);
    case Tone::good:
      return light ? ImVec4(0.05F, 0.45F, 0.15F, 1) : ImVec4(0.40F, 0.85F, 0.45F, 1);
    case Tone::warning:
      return light ? ImVec4(0.62F, 0.36F, 0.00F, 1) : ImVec4(1.00F, 0.76F, 0.30F, 1);
    case Tone::bad:
      return light ? ImVec4(0.75F, 0.08F, 0.08F, 1) : ImVec4(1.00F, 0.45F, 0.42F, 1);
  }
  return {};
}

ImU32 series_colour(int index) {
  // Okabe and Ito's colours, distinct with any colour vision.
  constexpr std::array<std::array<float, 3>, 7> kColours = {{{0.34F, 0.71F, 0.91F},
                                                             {0.90F, 0.62F, 0.00F},
                                                             {0.00F, 0.70F, 0.50F},
                                                             {0.94F, 0.89F, 0.26F},
                                                             {0.80F, 0.47F, 0.65F},
                                                             {0.84F, 0.37F, 0.00F},
                                                             {0.20F, 0.50F, 0.80F}}};
  const auto& [red, green, blue] = kColours[static_cast<std::size_t>(index) % kColours.size()];
  return ImGui::ColorConvertFloat4ToU32({red, green, blue, 1});
}

std::string saliency_text(float saliency) {
  if (saliency >= 0.01F) return fmt::format("{:.2f}", saliency);
  return saliency < 1e-4F ? "0" : fmt::format("{:.1g}", saliency);
}

void wrapped_text(const std::string& text, Tone tone) {
  ImGui::PushStyleColor(ImGuiCol_Text, tone_colour(tone));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void number_cell(const std::string& text, Tone tone) {
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::PushStyleColor(ImGuiCol_Text, tone_colour(tone));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

bool begin_labelled_rows(const char* id, const char* widest_label) {
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize(widest_label).x);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

void labelled_row(const char* label, const std::string& value, Tone tone, const std::string& explanation) {
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, tone_colour(Tone::quiet));
  ImGui::TextUnformatted(label);
  ImGui::PopStyleColor();
  explain(explanation);
  ImGui::TableNextColumn();
  wrapped_text(value, tone);
  explain(explanation);
}

void swatch(ImU32 colour) {
  const float side = ImGui::GetFontSize() * 0.7F;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float down = (ImGui::GetTextLineHeight() - side) / 2;
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + down}, {at.x + side, at.y + down + side}, colour,
                                            side / 5);
  ImGui::Dummy({side, ImGui::GetTextLineHeight()});
  ImGui::SameLine(0, side / 2);
}

void begin_named_row(const char* name, const std::string& explanation) {
  const float left = ImGui::GetCursorPosX();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(name);
  explain(explanation);
  ImGui::SameLine(left + 7.5F * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1);
}

void explain(const std::string& text) {
  if (!text.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) show_tool_tip(text);
}

void show_tool_tip(const std::string& text) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace saccade
