#include <algorithm>
#include <cmath>
#include <functional>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "ui/session/view_state.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> kComparisons = {"off", "side_by_side", "split", "difference"};
constexpr std::array<std::string_view, 3> kCentres = {"picture", "cloud", "both"};
constexpr std::array<std::string_view, 3> kCloudColours = {"image", "depth", "saliency"};
constexpr std::array<std::string_view, 2> kThemes = {"dark", "light"}, kBackgrounds = {"colour", "depth"};
constexpr std::array<std::string_view, kSidebarPanels> kPanelNames = {"tuning", "display",     "fixations",
                                                                      "probe",  "performance", "sensors"};

template <typename Enum, std::size_t N>
std::string word(const std::array<std::string_view, N>& words, Enum value) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

// Readers that leave `value` unchanged if the text has no fitting one.
void read(const Json& json, const char* key, bool& value) {
  if (const auto found = json.find(key); found != json.end() && found->is_boolean()) value = *found;
}

void read(const Json& json, const char* key, double& value, double low, double high) {
  if (const auto found = json.find(key); found != json.end() && found->is_number())
    value = std::clamp(found->get<double>(), low, high);
}

template <typename Enum, std::size_t N>
void read(const Json& json, const char* key, const std::array<std::string_view, N>& words, Enum& value) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_string()) return;
  const auto place = std::find(words.begin(), words.end(), found->get<std::string>());
  if (place != words.end()) value = static_cast<Enum>(place - words.begin());
}

void read(const Json& json, const char* key, Palette& value) {
  if (const auto found = json.find(key); found != json.end() && found->is_string())
    value = palette_named(found->get<std::string>()).value_or(value);
}

void read(const Json& json, const char* key, std::optional<ValueRange>& value) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array() || found->size() != 2) return;
  if (!(*found)[0].is_number() || !(*found)[1].is_number()) return;
  const ValueRange range{(*found)[0], (*found)[1]};
  if (std::isfinite(range.low) && std::isfinite(range.high) && range.low < range.high) value = range;
}

Json range_json(const std::optional<ValueRange>& range) {
  return range ? Json{range->low, range->high} : Json();
}

// The settings of the tuning panel; those of frames and program do not persist. Default levels are left out:
// reading them would make them explicitly chosen.
Json settings_json(const Settings& settings) {
  Json json = Json::object();
  for (const SettingSpec& spec : setting_specs())
    if (is_compared(spec) && (!spec.chosen || spec.chosen(settings)))
      json[std::string(spec.key)] = spec.print(settings);
  return json;
}

void read_settings(const Json& json, const char* key, Settings& settings) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_object()) return;
  for (const auto& [name, value] : found->items()) {
    if (!value.is_string()) continue;
    try {
      apply_setting(settings, name, value.get<std::string>());
    } catch (const Error&) {
      // A file of another version: this setting stays as it is.
    }
  }
}

}  // namespace

std::string view_state_json(const ViewState& state) {
  Json open = Json::object();
  for (std::size_t i = 0; i < kSidebarPanels; ++i) open[std::string(kPanelNames[i])] = state.open[i];
  const MapStyle& map = state.style.map;
  const Json json = {{"settings", settings_json(state.settings.a)},
                     {"settings_b", settings_json(state.settings.b)},
                     {"background", word(kBackgrounds, state.style.background)},
                     {"depth_palette", to_string(state.style.depth.palette)},
                     {"depth_range_mm", range_json(state.style.depth.range_mm)},
                     {"depth_percentile", state.style.depth.percentile},
                     {"map", state.show_map},
                     {"map_palette", to_string(map.palette)},
                     {"map_opacity", map.opacity},
                     {"map_threshold", map.threshold},
                     {"map_range", range_json(map.range)},
                     {"outlines", state.style.outlines},
                     {"marks", state.style.marks},
                     {"path", state.style.path},
                     {"comparison", word(kComparisons, state.comparison)},
                     {"common_range", state.common_range},
                     {"divider", state.divider},
                     {"centre", word(kCentres, state.centre)},
                     {"cloud_colour", word(kCloudColours, state.cloud.colour)},
                     {"cloud_lit", state.cloud.lit},
                     {"cloud_normals", state.cloud.needles},
                     {"cloud_fixations", state.cloud.fixations},
                     {"cloud_point_size", state.cloud.point_size},
                     {"theme", word(kThemes, state.theme)},
                     {"welcome", state.welcome},
                     {"sidebar", state.sidebar},
                     {"sidebar_width", state.sidebar_width},
                     {"text_size", state.ui_scale},
                     {"open", open},
                     {"window", {state.window.width, state.window.height}},
                     {"folder", state.folder},
                     {"recent", state.recent}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void apply_view_state(ViewState& state, const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return;
  read_settings(json, "settings", state.settings.a);
  read_settings(json, "settings_b", state.settings.b);
  read(json, "background", kBackgrounds, state.style.background);
  read(json, "depth_palette", state.style.depth.palette);
  read(json, "depth_range_mm", state.style.depth.range_mm);
  read(json, "depth_percentile", state.style.depth.percentile, 0, 25);
  read(json, "map", state.show_map);
  MapStyle& map = state.style.map;
  read(json, "map_palette", map.palette);
  read(json, "map_opacity", map.opacity, 0, 1);
  read(json, "map_threshold", map.threshold, 0, 1);
  read(json, "map_range", map.range);
  read(json, "outlines", state.style.outlines);
  read(json, "marks", state.style.marks);
  read(json, "path", state.style.path);
  read(json, "comparison", kComparisons, state.comparison);
  read(json, "common_range", state.common_range);
  read(json, "divider", state.divider, 0.02, 0.98);
  read(json, "centre", kCentres, state.centre);
  read(json, "cloud_colour", kCloudColours, state.cloud.colour);
  read(json, "cloud_lit", state.cloud.lit);
  read(json, "cloud_normals", state.cloud.needles);
  read(json, "cloud_fixations", state.cloud.fixations);
  auto point_size = static_cast<double>(state.cloud.point_size);
  read(json, "cloud_point_size", point_size, kSmallestPoint, kLargestPoint);
  state.cloud.point_size = static_cast<float>(point_size);
  read(json, "theme", kThemes, state.theme);
  read(json, "welcome", state.welcome);
  read(json, "sidebar", state.sidebar);
  read(json, "sidebar_width", state.sidebar_width, kNarrowestSidebar, kWidestSidebar);
  read(json, "text_size", state.ui_scale, 0, 4);
  if (const auto open = json.find("open"); open != json.end() && open->is_object())
    for (std::size_t i = 0; i < kSidebarPanels; ++i)
      read(*open, std::string(kPanelNames[i]).c_str(), state.open[i]);
  if (const auto window = json.find("window"); window != json.end() && window->is_array() &&
                                               window->size() == 2 && (*window)[0].is_number_integer() &&
                                               (*window)[1].is_number_integer() && (*window)[0] > 0)
    state.window = {std::clamp((*window)[0].get<int>(), 480, 16384),
                    std::clamp((*window)[1].get<int>(), 360, 16384)};
  if (const auto folder = json.find("folder"); folder != json.end() && folder->is_string())
    state.folder = folder->get<std::string>();
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (auto uri = recent->rbegin(); uri != recent->rend(); ++uri)
      if (uri->is_string()) remember_source(state, uri->get<std::string>());
}

}  // namespace saccade
