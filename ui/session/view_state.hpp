#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "output/overlay.hpp"
#include "ui/session/cloud_vertices.hpp"
#include "ui/session/compared_settings.hpp"
#include "ui/session/view_result.hpp"

namespace saccade {

enum class Comparison { off, side_by_side, split, difference };
enum class Centre { picture, cloud, both };
enum class Theme { dark, light };

/// The panels of the side bar, each open or closed.
enum class SidebarPanel { tuning, display, fixations, probe, performance, sensors, count };
constexpr std::size_t kSidebarPanels = static_cast<std::size_t>(SidebarPanel::count);

/// The state of the window that persists between sessions.
struct ViewState {
  ComparedSettings settings;
  OverlayStyle style;
  bool show_map = true;
  Comparison comparison = Comparison::off;
  bool edit_b = false;       ///< while comparing: the tuning panel edits B
  bool common_range = true;  ///< A and B have the colours of one range, unless their models differ
  double divider = 0.5;      ///< of the split, share of the picture's width
  Centre centre = Centre::picture;
  CloudStyle cloud;
  Theme theme = Theme::dark;
  double ui_scale = 0;  ///< 0 = the screen's own scale
  bool welcome = true;  ///< the welcome card at a start without a source
  bool sidebar = true;
  double sidebar_width = 340;  ///< px at scale 1
  std::array<bool, kSidebarPanels> open = {true, true, false, false, false, false};
  cv::Size window;     ///< px; empty = as large as the text needs
  std::string folder;  ///< for recordings and snapshots; empty = the working directory, or the home folder
  std::vector<std::string> recent;  ///< sources, newest first

  bool& is_open(SidebarPanel panel) { return open[static_cast<std::size_t>(panel)]; }
  bool is_open(SidebarPanel panel) const { return open[static_cast<std::size_t>(panel)]; }

  /// The settings that the tuning panel shows.
  Settings& edited() { return comparing() && edit_b ? settings.b : settings.a; }
  bool comparing() const { return comparison != Comparison::off; }
};

constexpr std::size_t kMostRecent = 8;
constexpr double kNarrowestSidebar = 300, kWidestSidebar = 700;  ///< px at scale 1

/// Moves a source to the front of the recent ones.
void remember_source(ViewState& state, const std::string& uri);

/// The style of an overlay that looks like the picture: without a map if that is hidden.
[[nodiscard]] OverlayStyle shown_style(const ViewState& state);

/// The style of both maps of a comparison: on one range where the state asks for it, none is locked, and both
/// are of one model. Over time the range is that of
/// SequenceMarks, so that colours do not flicker from frame to frame.
[[nodiscard]] MapStyle shown_map_style(const ViewState& state, const ViewResult& result);

/// The next model or palette, from the last one back to the first; `step` 1 or -1.
void next_model(Settings& settings, int step);
void next_palette(MapStyle& style);

/// The possible values of a setting of words, such as "model", in the order of the help.
[[nodiscard]] std::vector<std::string> choices_of(std::string_view key);

/// The kernel `steps` sizes further: windows are odd, so 14 and 15 are the same size.
[[nodiscard]] int next_kernel(int kernel, int steps);

/// The speeds of the player, slowest first; the last, 0, is as fast as possible.
[[nodiscard]] std::span<const double> play_speeds();
[[nodiscard]] double next_speed(double speed, int steps);

/// ViewState as JSON text. Missing and bad values in the text leave `state` as it is, so that a file of
/// another version or a damaged one never keeps the window from opening.
[[nodiscard]] std::string view_state_json(const ViewState& state);
void apply_view_state(ViewState& state, const std::string& json);

/// $XDG_CONFIG_HOME/saccade or ~/.config/saccade; empty if neither is known.
[[nodiscard]] std::filesystem::path config_folder();

}  // namespace saccade
