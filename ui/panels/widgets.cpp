#include "ui/panels/widgets.hpp"

#include <algorithm>

#include <imgui_internal.h>

namespace saccade {
namespace {

void triangle(ImDrawList& draw, ImVec2 c, float r, float direction, unsigned colour) {
  draw.AddTriangleFilled({c.x - direction * r * 0.8F, c.y - r}, {c.x - direction * r * 0.8F, c.y + r},
                         {c.x + direction * r, c.y}, colour);
}

void bar(ImDrawList& draw, float x, ImVec2 c, float r, float width, unsigned colour) {
  draw.AddRectFilled({x - width / 2, c.y - r}, {x + width / 2, c.y + r}, colour);
}

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 c, float r, unsigned colour) {
  const float thin = r * 0.45F;
  switch (icon) {
    case Icon::play:
      return triangle(draw, c, r, 1, colour);
    case Icon::pause:
      bar(draw, c.x - r * 0.5F, c, r, thin, colour);
      return bar(draw, c.x + r * 0.5F, c, r, thin, colour);
    case Icon::step_forward:
      triangle(draw, {c.x + r * 0.25F, c.y}, r * 0.85F, 1, colour);
      return bar(draw, c.x - r * 0.85F, c, r * 0.85F, thin * 0.8F, colour);
    case Icon::step_back:
      triangle(draw, {c.x - r * 0.25F, c.y}, r * 0.85F, -1, colour);
      return bar(draw, c.x + r * 0.85F, c, r * 0.85F, thin * 0.8F, colour);
    case Icon::last:
      triangle(draw, {c.x - r * 0.25F, c.y}, r * 0.85F, 1, colour);
      return bar(draw, c.x + r * 0.85F, c, r * 0.85F, thin * 0.8F, colour);
    case Icon::first:
      triangle(draw, {c.x + r * 0.25F, c.y}, r * 0.85F, -1, colour);
      return bar(draw, c.x - r * 0.85F, c, r * 0.85F, thin * 0.8F, colour);
    case Icon::loop:
      draw.PathArcTo(c, r * 0.85F, 0.6F, 5.6F, 24);
      draw.PathStroke(colour, 0, r * 0.28F);
      draw.AddTriangleFilled({c.x + r * 0.25F, c.y - r * 0.35F}, {c.x + r * 1.15F, c.y - r * 0.25F},
                             {c.x + r * 0.8F, c.y - r * 1.1F}, colour);
      return;
    case Icon::record:
      return draw.AddCircleFilled(c, r * 0.9F, colour);
    case Icon::camera:
      draw.AddRectFilled({c.x - r * 0.45F, c.y - r}, {c.x + r * 0.45F, c.y}, colour, r * 0.2F);
      draw.AddRect({c.x - r * 1.2F, c.y - r * 0.6F}, {c.x + r * 1.2F, c.y + r * 0.9F}, colour, r * 0.25F, 0,
                   r * 0.3F);
      return draw.AddCircle({c.x, c.y + r * 0.15F}, r * 0.4F, colour, 0, r * 0.28F);
  }
}

// "openni2:1d27/0601@1/4"; a path may hold a colon too, but hardly before its first slash.
bool is_not_a_path(const std::string& uri) { return uri.find(':') < uri.find('/'); }

}  // namespace

std::string short_name(const std::string& uri) {
  if (uri.find('/') == std::string::npos || is_not_a_path(uri)) return uri;
  const auto end = uri.find_last_not_of('/');
  const std::string path = uri.substr(0, end == std::string::npos ? 0 : end + 1);
  const std::string name = path.substr(path.rfind('/') + 1);
  return name.empty() ? uri : name;
}

bool begin_dialog(ViewContext& view, const char* title, bool& opening, double width) {
  if (opening) ImGui::OpenPopup(title);
  opening = false;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(view.px(width), size.x * 0.96F), 0});
  bool stays = true;
  return ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
}

void close_top_popup() {
  const int popups = ImGui::GetCurrentContext()->OpenPopupStack.Size;
  if (popups > 0) ImGui::ClosePopupToLevel(popups - 1, true);
}

bool icon_button(ViewContext& view, const char* id, Icon icon, bool lit, const std::string& text) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::Button(id, {side * 1.15F, side});
  const ThemeColours& c = *view.colours;
  draw_icon(*ImGui::GetWindowDrawList(), icon, {corner.x + side * 0.575F, corner.y + side / 2}, side * 0.22F,
            !lit                   ? c.text
            : icon == Icon::record ? c.error
                                   : c.accent);
  explain(text);
  return pressed;
}

bool segments(ViewContext& view, const char* id, const std::vector<std::string>& names, int& chosen) {
  bool changed = false;
  ImGui::PushID(id);
  ImGui::BeginGroup();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {view.px(1), ImGui::GetStyle().ItemSpacing.y});
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    if (i > 0) ImGui::SameLine();
    const bool on = i == chosen;
    if (on) {
      ImGui::PushStyleColor(ImGuiCol_Button, as_vec4((view.colours->accent & 0x00ffffff) | 0x50000000));
      ImGui::PushStyleColor(ImGuiCol_ButtonHovered,
                            as_vec4((view.colours->accent & 0x00ffffff) | 0x60000000));
    }
    if (ImGui::Button(names[static_cast<std::size_t>(i)].c_str()) && !on) {
      chosen = i;
      changed = true;
    }
    if (on) ImGui::PopStyleColor(2);
  }
  ImGui::PopStyleVar();
  ImGui::EndGroup();
  ImGui::PopID();
  return changed;
}

bool word_combo(const char* id, const std::vector<std::string>& words, std::string& word,
                std::string (*help)(const std::string& word)) {
  bool changed = false;
  if (!ImGui::BeginCombo(id, word.c_str(), ImGuiComboFlags_HeightLargest)) return false;
  for (const std::string& choice : words) {
    if (ImGui::Selectable(choice.c_str(), choice == word) && choice != word) {
      word = choice;
      changed = true;
    }
    if (help != nullptr) explain(help(choice));
  }
  ImGui::EndCombo();
  return changed;
}

void clipped_text(const std::string& text, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos(), size = ImGui::CalcTextSize(text.c_str());
  const float right = at.x + std::max(width, 1.0F),
              top = at.y + ImGui::GetCurrentWindow()->DC.CurrLineTextBaseOffset;
  ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), {at.x, top}, {right, top + size.y}, right, right,
                            text.c_str(), nullptr, &size);
  ImGui::Dummy({std::min(size.x, right - at.x), size.y});
}

std::string shortened(const std::string& text, std::size_t most) {
  constexpr std::string_view kDots = "…";
  if (text.size() <= most) return text;
  const auto inside = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
  const std::size_t half = (most - kDots.size()) / 2;
  std::size_t head = half, tail = text.size() - half;
  while (head > 0 && inside(head)) --head;  // not within a character
  while (tail < text.size() && inside(tail)) ++tail;
  return text.substr(0, head).append(kDots).append(text.substr(tail));
}

void set_text(std::span<char> field, const std::string& text) {
  field[text.copy(field.data(), field.size() - 1)] = '\0';
}

std::string with_key(const std::string& text, Action action) {
  const std::string key = key_name(action);
  return key.empty() ? text : text + " (" + key + ")";
}

void log_place(ViewContext& view, const char* name) { log_place(view, place_of_item(name)); }

void log_place(ViewContext& view, const ItemPlace& place) {
  view.places[place.name] = {place.low.x, place.low.y, place.high.x, place.high.y};
}

}  // namespace saccade
