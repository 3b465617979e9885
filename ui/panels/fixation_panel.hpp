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
  void draw_row(ViewContext& view, const Fixation& fixation, int index);
  std::vector<int> order_;  // of the rows, as the user sorts them
};

/// The table as text: a heading and a line for each fixation, with tabs.
[[nodiscard]] std::string fixation_text(const std::vector<Fixation>& fixations);

}  // namespace saccade
