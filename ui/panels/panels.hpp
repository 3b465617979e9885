#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "ui/panels/fixation_panel.hpp"
#include "ui/panels/picture_drawing.hpp"
#include "ui/panels/probe_panel.hpp"
#include "ui/panels/sensor_panel.hpp"
#include "ui/panels/view_context.hpp"

namespace saccade {

// The parts of the window. A panel is one small file with a function, or with a class if it keeps a state,
// that draws into ImGui's current window. How to add one: ui/README.md.

void draw_top_bar(ViewContext& view);
void draw_tuning_panel(ViewContext& view);
void draw_display_panel(ViewContext& view);
void draw_transport(ViewContext& view);
void draw_timeline(ViewContext& view, std::int64_t frames);  ///< of a recording of `frames` > 0 frames
void draw_messages(ViewContext& view);
void draw_performance_panel(ViewContext& view);

/// The open source and its state.
[[nodiscard]] SourceFacts source_facts(const ViewContext& view);

/// A large message from `low` to `high`: why there is no picture yet, or that the sensor is lost. Nothing
/// while frames come.
void draw_state_banner(ViewContext& view, ImVec2 low, ImVec2 high);

/// The first words for a user who has asked for nothing, at the top left of an area, while view.welcome.
void draw_welcome(ViewContext& view, ImVec2 low, ImVec2 high);

/// The help over the window.
class HelpDialog {
 public:
  /// Opens or closes it with the next draw().
  void toggle() { (open_ ? closing_ : opening_) = true; }
  bool is_open() const { return open_; }
  void draw(ViewContext& view);

 private:
  bool opening_ = false, closing_ = false, open_ = false;
};

/// The side bar with its panels.
class Sidebar {
 public:
  /// As SensorPanel.
  Sidebar(DeviceWatch::List list_sensors, std::function<void()> wake)
      : sensors_(std::move(list_sensors), std::move(wake)) {}

  void draw(ViewContext& view);
  SensorPanel& sensors() { return sensors_; }

 private:
  void draw_panel(ViewContext& view, SidebarPanel panel);
  FixationPanel fixations_;
  ProbePanel probe_;
  SensorPanel sensors_;
};

/// The picture: one, two side by side, or two with a divider.
class PicturePanel {
 public:
  PicturePanel();
  ~PicturePanel();
  void draw(ViewContext& view);
  void fit();
  /// For another source: fits the picture and drops the last frame.
  void reset();

 private:
  struct Layers;
  void draw_side(ViewContext& view, const PictureSide& side);
  void handle_mouse(ViewContext& view, const PictureSide& side);
  void click(ViewContext& view, const PictureSide& side);
  std::unique_ptr<Layers> layers_;
};

}  // namespace saccade
