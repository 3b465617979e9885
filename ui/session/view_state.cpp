#include "ui/session/view_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

namespace saccade {
namespace {

constexpr std::array kSpeeds = {0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 0.0};

// The word that is `step` further, around the end.
std::string next_word(const std::vector<std::string>& words, const std::string& word, int step) {
  const auto found = std::find(words.begin(), words.end(), word);
  const auto count = static_cast<std::ptrdiff_t>(words.size());
  const std::ptrdiff_t at = found == words.end() ? 0 : found - words.begin() + step;
  return words[static_cast<std::size_t>((at % count + count) % count)];
}

}  // namespace

void remember_source(ViewState& state, const std::string& uri) {
  std::erase(state.recent, uri);
  state.recent.insert(state.recent.begin(), uri);
  if (state.recent.size() > kMostRecent) state.recent.resize(kMostRecent);
}

OverlayStyle shown_style(const ViewState& state) {
  OverlayStyle style = state.style;
  if (!state.show_map) style.map.opacity = 0;
  return style;
}

MapStyle shown_map_style(const ViewState& state, const ViewResult& result) {
  MapStyle style = state.style.map;
  if (!style.range && result.a.marks && !(state.comparing() && result.compared)) {
    style.range = ValueRange{0, result.a.marks->range_high};
    return style;
  }
  if (!state.comparing() || !state.common_range || style.range || !result.compared ||
      result.a.settings.model != result.b.settings.model || !result.a.error.empty() ||
      !result.b.error.empty())
    return style;
  const auto high_of = [&](const Computed& side) {
    return side.marks ? side.marks->range_high : shown_range(side.smooth, style).high;
  };
  const float high = std::max(high_of(result.a), high_of(result.b));
  if (high > 0) style.range = ValueRange{0, high};
  return style;
}

std::vector<std::string> choices_of(std::string_view key) { return setting_spec(key).words; }

void next_model(Settings& settings, int step) {
  settings.model = next_word(choices_of("model"), settings.model, step);
}

void next_palette(MapStyle& style) {
  const auto found = std::find(kPalettes.begin(), kPalettes.end(), style.palette);
  style.palette = found + 1 == kPalettes.end() ? kPalettes.front() : *(found + 1);
}

int next_kernel(int kernel, int steps) { return std::clamp((kernel | 1) + 2 * steps, 3, 127); }

std::span<const double> play_speeds() { return kSpeeds; }

double next_speed(double speed, int steps) {
  const auto place = [](double s) { return s > 0 ? s : 1e9; };
  const auto nearest = std::min_element(kSpeeds.begin(), kSpeeds.end(), [&](double a, double b) {
    return std::abs(std::log(place(a) / place(speed))) < std::abs(std::log(place(b) / place(speed)));
  });
  const std::ptrdiff_t at = nearest - kSpeeds.begin() + steps;
  return kSpeeds[static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(kSpeeds.size()) - 1))];
}

std::filesystem::path config_folder() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder == '/')
    return std::filesystem::path(folder) / "saccade";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return std::filesystem::path(home) / ".config/saccade";
  return {};
}

}  // namespace saccade
