#include "ui/panels/picture_clicks.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "core/text.hpp"
#include "ui/panels/fixation_panel.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {

int fixation_of_a(const ViewResult& result, int index, bool is_b) {
  if (!is_b) return index;
  const std::vector<Fixation>& a = result.a.result.attention.fixations;
  const int id = result.b.result.attention.fixations[static_cast<std::size_t>(index)].id;
  const auto same = std::ranges::find(a, id, &Fixation::id);
  return id == 0 || same == a.end() ? -1 : static_cast<int>(same - a.begin());  // ranks name no object
}

void click_mark(ViewContext& view, int index) {
  if (index == view.locked)
    view.lock.unlock();
  else
    view.lock.lock(view.result->a.result.attention.fixations[static_cast<std::size_t>(index)]);
}

void click_pixel(ViewContext& view, std::optional<cv::Point> pixel, bool is_b) {
  if (view.pinned && ImGui::GetIO().KeyShift) {
    view.measured = pixel;
    return;
  }
  view.measured.reset();
  if (view.pinned) {
    view.pinned.reset();
    return;
  }
  view.pinned = pixel;
  view.pinned_on_b = is_b;
  view.lock.unlock();
}

void explain_fixation(const Computed& computed, int index, bool followed) {
  const Fixation& f = computed.result.attention.fixations[static_cast<std::size_t>(index)];
  std::string text = computed.marks ? object_text(computed, index) : fmt::format("Fixation {}", index + 1);
  text += fmt::format("\nrow {}, column {}\nsaliency {}{}", f.row, f.col, saliency_text(f.saliency),
                      computed.marks ? " (of the object, averaged over time)" : "");
  if (f.confidence) text += fmt::format("\nconfidence {:.2f}", *f.confidence);
  text += f.position_mm.z > 0 ? fmt::format("\nx y z {:.0f}, {:.0f}, {:.0f} mm", f.position_mm.x,
                                            f.position_mm.y, f.position_mm.z)
                              : "\nno depth there";
  if (f.proto_object.pixels > 0)
    text +=
        fmt::format("\nobject of {}, {:.0f} x {:.0f} x {:.0f} mm", counted(f.proto_object.pixels, "pixel"),
                    f.proto_object.extent_mm.x, f.proto_object.extent_mm.y, f.proto_object.extent_mm.z);
  if (followed) text += "\nA click follows it from frame to frame";
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace saccade
