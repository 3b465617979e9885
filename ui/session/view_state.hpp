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

namespace saccade {

enum class Comparison { off, side_by_side, split };
enum class Centre { picture, cloud, both };
enum class Theme { dark, light };

/// The sections of the side bar, each open or closed.
enum class SidebarPanel { tuning, display, probe, performance, sensors, count };
constexpr std::size_t kSidebarPanels = static_cast<std::size_t>(SidebarPanel::count);

/// Everything that a person set in the window and finds again the next time; neither ImGui nor OpenGL.
struct ViewState {
  ComparedSettings settings;
  OverlayStyle style;
  bool show_map = true;
  Comparison comparison = Comparison::off;
  bool edit_b = false;   ///< the tuning panel edits B; of interest while comparing
  double divider = 0.5;  ///< of the split, share of the picture's width
  Centre centre = Centre::picture;
  CloudStyle cloud;
  Theme theme = Theme::dark;
  double ui_scale = 0;  ///< 0 = what the screen says
  bool sidebar = true;
  double sidebar_width = 340;  ///< px at scale 1
  std::array<bool, kSidebarPanels> open = {true, true, false, false, false};
  cv::Size window{1280, 800};
  std::vector<std::string> recent;  ///< sources, newest first

  bool& is_open(SidebarPanel section) { return open[static_cast<std::size_t>(section)]; }
  bool is_open(SidebarPanel section) const { return open[static_cast<std::size_t>(section)]; }

  /// The settings that the tuning panel shows.
  Settings& edited() { return comparing() && edit_b ? settings.b : settings.a; }
  bool comparing() const { return comparison != Comparison::off; }
};

constexpr std::size_t kMostRecent = 8;

/// Puts a source in front of the recent ones, once.
void remember_source(ViewState& state, const std::string& uri);

/// The next of the models, palettes and selectors: `step` 1 or -1, around the end.
void next_model(Settings& settings, int step);
void next_palette(MapStyle& style);

/// The names that a setting of words may have, e.g. of "model"; in the order of the help.
std::vector<std::string> choices_of(std::string_view key);

/// Next size of a kernel that differs in the window: windows are odd, so 14 and 15 are the same.
int next_kernel(int kernel, int steps);

/// The speeds of the player, slowest first; 0 = as fast as possible stands last.
std::span<const double> play_speeds();
double next_speed(double speed, int steps);

/// ViewState as JSON text. What the text does not say, or says wrongly, stays as it is in `state`: an old or
/// spoiled file of another version never keeps the window from opening.
std::string view_state_json(const ViewState& state);
void apply_view_state(ViewState& state, const std::string& json);

/// $XDG_CONFIG_HOME/saccade or ~/.config/saccade; empty if neither is known.
std::filesystem::path config_folder();

}  // namespace saccade
