#include "ui/panels/picture_clicks.hpp"

#include <string>

#include <fmt/format.h>
#include <imgui.h>

#include "core/text.hpp"
#include "ui/panels/fixation_panel.hpp"
#include "ui/panels/panel_text.hpp"

namespace saccade {

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

void explain_fixation(const Computed& computed, int rank) {
  const Fixation& f = computed.result.attention.fixations[static_cast<std::size_t>(rank)];
  std::string text = computed.marks ? object_text(computed, rank) : fmt::format("Fixation {}", rank + 1);
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
  text += "\nA click follows it from frame to frame";
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace saccade
