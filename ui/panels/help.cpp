#include <array>
#include <utility>

#include <imgui.h>

#include "ui/panels/panels.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

using Row = std::pair<const char*, const char*>;

constexpr std::array<Row, 9> kMouse = {{
    {"Wheel", "zooms at the pointer"},
    {"Drag", "moves the picture, turns the points"},
    {"Right drag, Shift+drag", "moves the points"},
    {"Click, also in the points", "pins the probe; on a mark: follows its fixation"},
    {"Shift+click, while pinned", "measures the distance in space between both pixels"},
    {"Arrow keys, while pinned", "move the probe by a pixel, with Shift by ten"},
    {"Esc", "frees the probe and the fixation, closes a list"},
    {"Double click", "fits the picture; in the table: centres"},
    {"Drop a file or folder", "opens it"},
}};

constexpr std::array<Row, 9> kSeen = {{
    {"Colours over the picture",
     "The mean of the saliency around each pixel. Strong colours mark what attracts attention; the legend "
     "below the picture has the values, and a tick for the pixel under the mouse. Weak values are "
     "transparent."},
    {"Numbered discs",
     "Fixations, in the order in which the selector attends to them; the first is green. Over time each "
     "object keeps its number and its colour; those that were looked at a moment ago are faint."},
    {"Ring and trail", "Over time: the object that is looked at now, and where the gaze was before."},
    {"Lines between them", "Frame by frame: the scan path, from each fixation to the next."},
    {"Outlines", "Proto-objects: the surface that the selector takes as one object around a fixation."},
    {"saliency",
     "Everywhere the value of the map as it was computed, as in the files. Its peaks are only a few pixels "
     "wide, so the colours and their legend show its local mean, which is lower than the peaks, and say so."},
    {"Bars of the time line",
     "The largest saliency of each computed frame; grey where the settings have changed since."},
    {"Draft", "A quick result from coarser levels, while the exact one is computed."},
    {"A and B",
     "Two settings on the same frame; Tuning edits the chosen one. Over time what both find has one number "
     "and one colour. Points and the table of fixations are of A."},
}};

constexpr std::array<Row, 14> kGlossary = {{
    {"Saliency", "How much a place stands out from its surroundings and so attracts attention."},
    {"Saccade", "A rapid eye movement from one fixation to the next."},
    {"Fixation", "A place at which the gaze rests; here an attention point of the map."},
    {"Scan path", "The sequence of fixations."},
    {"3D symmetry",
     "The model of the paper: how well the points in a window mirror each other at a plane through its "
     "middle, in space instead of in the image."},
    {"Kernel", "The window around a pixel within which symmetry is measured."},
    {"Pyramid level",
     "The image at half the size of the level before; small windows there cover large objects."},
    {"Length scale",
     "The unit in which distances of point pairs are weighed: relative to the window, or millimetres."},
    {"Normalisation",
     "Weighs the map of each level before the levels are added: not at all (none), by its maximum "
     "(max), or so that maps with few strong peaks count more (itti)."},
    {"Selector", "Chooses fixations in a map."},
    {"Proto-object", "A region that attention treats as one thing before it is recognised."},
    {"Winner-take-all",
     "A network whose strongest cell wins and is then inhibited, so that the next one can win (wta)."},
    {"Inhibition of return", "A place that has been attended is suppressed for a while."},
    {"Registration", "Depth as seen from the colour camera, so that both images match pixel by pixel."},
}};

constexpr double kKeysWidth = 390;  // that the keys and what they do have room in

template <std::size_t N>
void draw_rows(ViewContext& view, const std::array<Row, N>& rows, double width) {
  for (const auto& [name, text] : rows) {
    ImGui::TextColored(as_vec4(view.colours->accent), "%s", name);
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + view.px(width));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
  }
}

void draw_keys(ViewContext& view, std::string_view group) {
  const auto list = shortcuts();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Shortcut& s = list[i];
    if (s.group != group || (i > 0 && list[i - 1].action == s.action)) continue;  // listed with its first key
    std::string keys = key_name(s);
    for (std::size_t k = i + 1; k < list.size() && list[k].action == s.action; ++k)
      keys += "  " + key_name(list[k]);
    ImGui::TextColored(as_vec4(view.colours->accent), "%s", keys.c_str());
    ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + view.px(140));
    ImGui::TextUnformatted(s.text.data(), s.text.data() + s.text.size());
  }
}

void draw_heading(ViewContext& view, const char* text) {
  ImGui::Dummy({0, view.px(2)});
  ImGui::PushFont(view.fonts.bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void draw_keys_and_mouse(ViewContext& view) {
  const int columns = ImGui::GetContentRegionAvail().x < view.px(2 * kKeysWidth) ? 1 : 2;
  if (!ImGui::BeginTable("keys", columns)) return;
  ImGui::TableNextColumn();
  for (const char* group : {"Playing", "Tuning"}) {
    draw_heading(view, group);
    draw_keys(view, group);
  }
  ImGui::TableNextColumn();
  for (const char* group : {"Picture", "General"}) {
    draw_heading(view, group);
    draw_keys(view, group);
  }
  ImGui::EndTable();
  draw_heading(view, "Mouse");
  draw_rows(view, kMouse, 210);
}

}  // namespace

void HelpDialog::draw(ViewContext& view) {
  open_ = begin_dialog(view, "Help", opening_, 860);
  if (!open_) return;
  const float room = ImGui::GetIO().DisplaySize.y * 0.94F - ImGui::GetFrameHeight() * 3;
  ImGui::BeginChild("pages", {0, std::min(view.px(640), room)});
  if (ImGui::BeginTabBar("tabs")) {
    if (ImGui::BeginTabItem("Keys and mouse")) {
      draw_keys_and_mouse(view);
      ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("What you see")) {
      draw_rows(view, kSeen, 200);
      ImGui::EndTabItem();
    }
    if (ImGui::BeginTabItem("Glossary")) {
      draw_rows(view, kGlossary, 170);
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::EndChild();
  if (std::exchange(closing_, false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace saccade
