#pragma once

#include <string>
#include <vector>

#include "ui/panels/view_context.hpp"

namespace saccade {

/// The table of the fixations on screen, linked with their marks: hovering shows which is which, a click
/// locks one, a double click centres it.
class FixationPanel {
 public:
  void draw(ViewContext& view);

 private:
  void draw_row(ViewContext& view, const Computed& computed, int index);
  std::vector<int> order_;  // of the rows, as the user sorts them
};

/// The table of a result as text: a heading and a line for each fixation, with tabs.
[[nodiscard]] std::string fixation_text(const Computed& computed);

/// What is known of the object of a fixation over time: "Object 7, seen for 3.2 s (96 frames), ...". Only
/// with Computed::marks. `index` counts from 0.
[[nodiscard]] std::string object_text(const Computed& computed, int index);

}  // namespace saccade
