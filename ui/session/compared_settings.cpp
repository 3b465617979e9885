#include "ui/session/compared_settings.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace saccade {
namespace {

constexpr std::array<std::string_view, 8> kCompared = {
    "model", "kernel", "levels", "length-scale", "normalisation", "selector", "fixations", "foa"};

}  // namespace

std::span<const std::string_view> compared_keys() { return kCompared; }

bool same_settings(const Settings& a, const Settings& b) {
  const auto specs = setting_specs();
  return a.levels_chosen == b.levels_chosen &&
         std::all_of(specs.begin(), specs.end(),
                     [&](const SettingSpec& spec) { return spec.print(a) == spec.print(b); });
}

bool ComparedSettings::operator==(const ComparedSettings& other) const {
  return same_settings(a, other.a) && same_settings(b, other.b);
}

void copy_compared(const Settings& from, Settings& to) {
  to.model = from.model;
  to.kernel = from.kernel;
  to.levels_chosen = from.levels_chosen;
  to.first_level = from.first_level;
  to.last_level = from.last_level;
  to.length_scale = from.length_scale;
  to.normalisation = from.normalisation;
  to.selector = from.selector;
  to.fixations = from.fixations;
  to.foa = from.foa;
}

void swap_sides(ComparedSettings& settings) {
  const Settings a = settings.a;
  copy_compared(settings.b, settings.a);
  copy_compared(a, settings.b);
}

void share_source(ComparedSettings& settings) {
  const Settings b = std::exchange(settings.b, settings.a);
  copy_compared(b, settings.b);
}

std::vector<std::string> load_compared(ComparedSettings& settings, bool into_b, const std::string& path) {
  Settings loaded = settings.a;
  copy_compared(Settings{}, loaded);
  load_settings(loaded, path);
  settings.a.intrinsics = loaded.intrinsics;
  settings.a.sensor = loaded.sensor;
  settings.a.simd = loaded.simd;
  copy_compared(loaded, into_b ? settings.b : settings.a);
  share_source(settings);
  std::vector<std::string> left;
  const auto is_tuned = [](std::string_view key) {
    return std::find(kCompared.begin(), kCompared.end(), key) != kCompared.end();
  };
  for (const SettingSpec& spec : setting_specs())
    if (!is_tuned(spec.key) && spec.print(loaded) != spec.print(settings.a)) left.emplace_back(spec.key);
  return left;
}

}  // namespace saccade
