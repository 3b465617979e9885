#include "ui/panels/fixation_panel.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>
#include <imgui.h>

#include "core/text.hpp"
#include "ui/panels/widgets.hpp"

namespace saccade {
namespace {

struct Column {
  const char* name;
  float width;  // relative to the others'
  const char* explanation;
  double (*value)(const Computed&, std::size_t index);  // to sort by
};

const Fixation& fixation_of(const Computed& computed, std::size_t index) {
  return computed.result.attention.fixations[index];
}

double largest_extent(const Fixation& f) {
  const cv::Point3f& e = f.proto_object.extent_mm;
  return static_cast<double>(std::max({e.x, e.y, e.z}));
}

// The last one is shown over time only.
constexpr std::array<Column, 8> kColumns = {{
    {"#", 2.6F,
     "In the order in which the selector attends to them: their rank or, over time, the number of the object",
     [](const Computed&, std::size_t i) { return static_cast<double>(i); }},
    {"x", 4.5F, "Millimetres to the right of the camera",
     [](const Computed& c, std::size_t i) { return static_cast<double>(fixation_of(c, i).position_mm.x); }},
    {"y", 4.5F, "Millimetres below the camera",
     [](const Computed& c, std::size_t i) { return static_cast<double>(fixation_of(c, i).position_mm.y); }},
    {"z", 4.5F, "Millimetres in front of the camera",
     [](const Computed& c, std::size_t i) { return static_cast<double>(fixation_of(c, i).position_mm.z); }},
    {"size", 4, "Longest side of the proto-object's box, mm; of the selector proto only",
     [](const Computed& c, std::size_t i) { return largest_extent(fixation_of(c, i)); }},
    {"sal.", 4,
     "Saliency: the value of the map at the fixation's pixel; over time, the mean of the strongest value on "
     "its object",
     [](const Computed& c, std::size_t i) { return static_cast<double>(fixation_of(c, i).saliency); }},
    {"conf.", 4.4F,
     "Confidence: how probable it is that the fixation lies on an object; of the selector proto only",
     [](const Computed& c, std::size_t i) {
       return static_cast<double>(fixation_of(c, i).confidence.value_or(0));
     }},
    {"looks", 4.6F, "How often the gaze has turned to the object",
     [](const Computed& c, std::size_t i) { return static_cast<double>(c.marks->marks[i].looks); }},
}};

int columns_of(const Computed& computed) {
  return static_cast<int>(kColumns.size()) - (computed.marks ? 0 : 1);
}

// The names are drawn here: ImGui leaves room for an arrow in each cell, and cuts them off.
void draw_header(int columns) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int i = 0; i < columns; ++i) {
    const Column& column = kColumns[static_cast<std::size_t>(i)];
    ImGui::TableSetColumnIndex(i);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(column.name).x;
    ImGui::TableHeader((std::string("##") + column.name).c_str());
    explain(column.explanation);
    const float left = i == 0 ? 0 : std::max(room, 0.0F);  // over the numbers, which end at the right
    ImGui::GetWindowDrawList()->AddText({corner.x + left, corner.y}, ImGui::GetColorU32(ImGuiCol_Text),
                                        column.name);
  }
}

void sort(std::vector<int>& order, const Computed& computed) {
  order.resize(computed.result.attention.fixations.size());
  std::iota(order.begin(), order.end(), 0);
  const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs == nullptr || specs->SpecsCount == 0) return;
  const auto& column = kColumns[static_cast<std::size_t>(specs->Specs[0].ColumnIndex)];
  const bool down = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
  const auto value = [&](int i) { return column.value(computed, static_cast<std::size_t>(i)); };
  std::ranges::stable_sort(order,
                           [&](int a, int b) { return down ? value(b) < value(a) : value(a) < value(b); });
}

}  // namespace

std::string fixation_text(const Computed& computed) {
  std::string text = "rank\tid\trow\tcol\tx_mm\ty_mm\tz_mm\tsize_mm\tsaliency\tconfidence\tlooks\n";
  for (std::size_t i = 0; i < computed.result.attention.fixations.size(); ++i) {
    const Fixation& f = fixation_of(computed, i);
    text += fmt::format("{}\t{}\t{}\t{}\t{:.1f}\t{:.1f}\t{:.1f}\t{:.1f}\t{:g}\t{}\t{}\n", i + 1,
                        f.id != 0 ? fmt::format("{}", f.id) : "", f.row, f.col, f.position_mm.x,
                        f.position_mm.y, f.position_mm.z, largest_extent(f), f.saliency,
                        f.confidence ? fmt::format("{:.3f}", *f.confidence) : "",
                        computed.marks ? fmt::format("{}", computed.marks->marks[i].looks) : "");
  }
  return text;
}

std::string object_text(const Computed& computed, int index) {
  const Fixation& f = computed.result.attention.fixations[static_cast<std::size_t>(index)];
  const SequenceMarks::Mark& mark = computed.marks->marks[static_cast<std::size_t>(index)];
  return fmt::format(
      "Object {}, rank {}{}\nknown for {:.1f} s, seen in {}\n{}\n"
      "world {:.0f}, {:.0f}, {:.0f} mm",
      f.id, index + 1,
      computed.result.attention.sequence->gaze == f.id ? ", looked at now"
      : mark.attended                                  ? ", looked at a moment ago"
                                                       : "",
      mark.age_s, counted(f.age_frames, "frame"),
      mark.looks == 0   ? "not looked at yet"
      : mark.looks == 1 ? "looked at once"
                        : fmt::format("looked at {} times", mark.looks),
      f.world_mm.x, f.world_mm.y, f.world_mm.z);
}

void FixationPanel::draw(ViewContext& view) {
  const Computed* computed = view.result ? &view.result->a : nullptr;
  if (computed == nullptr || computed->result.attention.fixations.empty())
    return wrapped_text("No fixation in this frame.", Tone::quiet);
  const std::vector<Fixation>& fixations = computed->result.attention.fixations;
  constexpr int kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_RowBg;
  const int columns = columns_of(*computed);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {view.px(2), view.px(2)});
  if (ImGui::BeginTable(computed->marks ? "objects" : "fixations", columns, kFlags)) {
    for (int i = 0; i < columns; ++i) {
      const Column& column = kColumns[static_cast<std::size_t>(i)];
      ImGui::TableSetupColumn(column.name, ImGuiTableColumnFlags_WidthStretch, column.width);
    }
    draw_header(columns);
    sort(order_, *computed);
    for (const int index : order_) draw_row(view, *computed, index);
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  if (ImGui::Button("Copy as text")) {
    ImGui::SetClipboardText(fixation_text(*computed).c_str());
    view.notify("Copied " + counted(fixations.size(), "fixation"));
  }
  log_place(view, "copy fixations");
  explain("Copies the table, with tabs between its columns");
  if (view.lock.locked()) {
    ImGui::SameLine();
    if (ImGui::Button("Unlock")) view.lock.unlock();
    explain("Follows no fixation any more (Esc)");
  }
  if (view.lock.locked() && view.locked < 0)
    wrapped_text("The locked fixation is not in this frame.", Tone::quiet);
  if (!computed->result.attention.ended_early.empty())
    wrapped_text(computed->result.attention.ended_early, Tone::quiet);
}

void FixationPanel::draw_row(ViewContext& view, const Computed& computed, int index) {
  const Fixation& fixation = computed.result.attention.fixations[static_cast<std::size_t>(index)];
  const bool chosen = index == view.locked, hovered_mark = index == view.hovered_mark;
  ImGui::TableNextRow();
  if (chosen || hovered_mark)
    ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0,
                           (view.colours->accent & 0x00ffffff) | (chosen ? 0x60000000U : 0x38000000U));
  ImGui::TableNextColumn();
  const std::string rank = fmt::format("{}", index + 1);
  constexpr int kFlags = ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick;
  const std::string number = computed.marks ? fmt::format("{}", fixation.id) : rank;
  if (ImGui::Selectable(number.c_str(), false, kFlags)) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
      view.lock.lock(fixation);
      view.centre_on = fixation;
    } else {
      chosen ? view.lock.unlock() : view.lock.lock(fixation);
    }
  }
  log_place(view, ("fixation " + rank).c_str());
  if (ImGui::IsItemHovered()) view.hovered_row = index;
  explain((computed.marks ? object_text(computed, index) + "\n" : "") +
          "A click follows this fixation from frame to frame, a double click centres it");
  const bool depth = fixation.position_mm.z > 0, object = fixation.proto_object.pixels > 0;
  number_cell(depth ? fmt::format("{:.0f}", fixation.position_mm.x) : "–");
  number_cell(depth ? fmt::format("{:.0f}", fixation.position_mm.y) : "–");
  number_cell(depth ? fmt::format("{:.0f}", fixation.position_mm.z) : "–");
  number_cell(object ? fmt::format("{:.0f}", largest_extent(fixation)) : "–");
  number_cell(saliency_text(fixation.saliency));
  number_cell(fixation.confidence ? fmt::format("{:.2f}", *fixation.confidence) : "–");
  if (computed.marks)
    number_cell(fmt::format("{}", computed.marks->marks[static_cast<std::size_t>(index)].looks));
}

}  // namespace saccade
