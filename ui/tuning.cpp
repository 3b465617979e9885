#include "ui/tuning.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace saccade {
namespace {

constexpr std::array<std::string_view, 8> kTuned = {"model",         "kernel",   "levels",    "length-scale",
                                                    "normalisation", "selector", "fixations", "foa"};

}  // namespace

std::span<const std::string_view> tuned_keys() { return kTuned; }

bool same_settings(const Settings& a, const Settings& b) {
  const auto specs = setting_specs();
  return a.levels_chosen == b.levels_chosen &&
         std::all_of(specs.begin(), specs.end(),
                     [&](const SettingSpec& spec) { return spec.print(a) == spec.print(b); });
}

bool Tuning::operator==(const Tuning& other) const {
  return same_settings(a, other.a) && same_settings(b, other.b);
}

void copy_tuned(const Settings& from, Settings& to) {
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

void swap_sides(Tuning& tuning) {
  const Settings a = tuning.a;
  copy_tuned(tuning.b, tuning.a);
  copy_tuned(a, tuning.b);
}

void share_source(Tuning& tuning) {
  const Settings b = std::exchange(tuning.b, tuning.a);
  copy_tuned(b, tuning.b);
}

std::vector<std::string> load_tuning(Tuning& tuning, bool into_b, const std::string& path) {
  Settings loaded = tuning.a;
  copy_tuned(Settings{}, loaded);
  load_settings(loaded, path);
  tuning.a.intrinsics = loaded.intrinsics;
  tuning.a.sensor = loaded.sensor;
  tuning.a.simd = loaded.simd;
  copy_tuned(loaded, into_b ? tuning.b : tuning.a);
  share_source(tuning);
  std::vector<std::string> left;
  const auto is_tuned = [](std::string_view key) {
    return std::find(kTuned.begin(), kTuned.end(), key) != kTuned.end();
  };
  for (const SettingSpec& spec : setting_specs())
    if (!is_tuned(spec.key) && spec.print(loaded) != spec.print(tuning.a)) left.emplace_back(spec.key);
  return left;
}

}  // namespace saccade
