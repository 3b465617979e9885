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
  const char* explanation;
  double (*value)(const Fixation&);  // to sort by; nullptr: the rank
};

double largest_extent(const Fixation& f) {
  const cv::Point3f& e = f.proto_object.extent_mm;
  return static_cast<double>(std::max({e.x, e.y, e.z}));
}

constexpr std::array<Column, 7> kColumns = {{
    {"#",
     "In the order in which the selector attends to them: their rank or, over time, the number of the object",
     nullptr},
    {"x", "Millimetres to the right of the camera",
     [](const Fixation& f) { return static_cast<double>(f.position_mm.x); }},
    {"y", "Millimetres below the camera",
     [](const Fixation& f) { return static_cast<double>(f.position_mm.y); }},
    {"z", "Millimetres in front of the camera",
     [](const Fixation& f) { return static_cast<double>(f.position_mm.z); }},
    {"size", "Longest side of the proto-object's box, mm; of the selector proto only", largest_extent},
    {"saliency", "Of the map at the fixation's pixel or, over time, of its object",
     [](const Fixation& f) { return static_cast<double>(f.saliency); }},
    {"conf.",
     "Confidence: how probable it is that the fixation lies on an object; of the selector proto only",
     [](const Fixation& f) { return static_cast<double>(f.confidence.value_or(0)); }},
}};

void draw_header() {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int i = 0; i < static_cast<int>(kColumns.size()); ++i) {
    ImGui::TableSetColumnIndex(i);
    ImGui::TableHeader(kColumns[static_cast<std::size_t>(i)].name);
    explain(kColumns[static_cast<std::size_t>(i)].explanation);
  }
}

void sort(std::vector<int>& order, const std::vector<Fixation>& fixations) {
  order.resize(fixations.size());
  std::iota(order.begin(), order.end(), 0);
  const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs == nullptr || specs->SpecsCount == 0) return;
  const auto& column = kColumns[static_cast<std::size_t>(specs->Specs[0].ColumnIndex)];
  const bool down = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
  std::ranges::stable_sort(order, [&](int a, int b) {
    if (down) std::swap(a, b);
    if (column.value == nullptr) return a < b;
    return column.value(fixations[static_cast<std::size_t>(a)]) <
           column.value(fixations[static_cast<std::size_t>(b)]);
  });
}

}  // namespace

std::string fixation_text(const std::vector<Fixation>& fixations) {
  std::string text = "rank\tid\trow\tcol\tx_mm\ty_mm\tz_mm\tsize_mm\tsaliency\tconfidence\n";
  int rank = 0;
  for (const Fixation& f : fixations)
    text += fmt::format("{}\t{}\t{}\t{}\t{:.1f}\t{:.1f}\t{:.1f}\t{:.1f}\t{:g}\t{}\n", ++rank,
                        f.id != 0 ? fmt::format("{}", f.id) : "", f.row, f.col, f.position_mm.x,
                        f.position_mm.y, f.position_mm.z, largest_extent(f), f.saliency,
                        f.confidence ? fmt::format("{:.3f}", *f.confidence) : "");
  return text;
}

std::string object_text(const Computed& computed, int index) {
  const Fixation& f = computed.result.attention.fixations[static_cast<std::size_t>(index)];
  const SequenceMarks::Mark& mark = computed.marks->marks[static_cast<std::size_t>(index)];
  return fmt::format(
      "Object {}, rank {}{}\nknown for {:.1f} s, seen in {} frame{}\nlooked at {}\n"
      "world {:.0f}, {:.0f}, {:.0f} mm",
      f.id, index + 1,
      computed.result.attention.sequence->gaze == f.id ? ", looked at now"
      : mark.attended                                  ? ", looked at a moment ago"
                                                       : "",
      mark.age_s, f.age_frames, f.age_frames == 1 ? "" : "s",
      mark.looks == 1 ? "once" : fmt::format("{} times", mark.looks), f.world_mm.x, f.world_mm.y,
      f.world_mm.z);
}

void FixationPanel::draw(ViewContext& view) {
  const Computed* computed = view.result ? &view.result->a : nullptr;
  if (computed == nullptr || computed->result.attention.fixations.empty())
    return wrapped_text("No fixation in this frame.", Tone::quiet);
  const std::vector<Fixation>& fixations = computed->result.attention.fixations;
  constexpr int kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (ImGui::BeginTable("fixations", static_cast<int>(kColumns.size()), kFlags)) {
    for (const Column& column : kColumns) ImGui::TableSetupColumn(column.name);
    draw_header();
    sort(order_, fixations);
    for (const int index : order_) draw_row(view, *computed, index);
    ImGui::EndTable();
  }
  if (ImGui::Button("Copy as text")) {
    ImGui::SetClipboardText(fixation_text(fixations).c_str());
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
  number_cell(fmt::format("{:.2g}", fixation.saliency));
  number_cell(fixation.confidence ? fmt::format("{:.2f}", *fixation.confidence) : "–");
}

}  // namespace saccade
