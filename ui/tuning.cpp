#include "ui/tuning.hpp"

#include <algorithm>
#include <utility>

namespace saccade {

bool is_tuned(const SettingSpec& spec) {
  return spec.scope == SettingScope::model || spec.scope == SettingScope::attention;
}

bool same_settings(const Settings& a, const Settings& b) {
  const auto specs = setting_specs();
  return std::all_of(specs.begin(), specs.end(), [&](const SettingSpec& spec) {
    return spec.print(a) == spec.print(b) && (!spec.chosen || spec.chosen(a) == spec.chosen(b));
  });
}

bool Tuning::operator==(const Tuning& other) const {
  return same_settings(a, other.a) && same_settings(b, other.b);
}

void copy_tuned(const Settings& from, Settings& to) {
  static_cast<ModelSettings&>(to) = from;
  static_cast<AttentionSettings&>(to) = from;
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
  copy_tuned(loaded, into_b ? tuning.b : tuning.a);
  share_source(tuning);
  std::vector<std::string> left;
  for (const SettingSpec& spec : setting_specs())
    if (!is_tuned(spec) && spec.print(loaded) != spec.print(tuning.a)) left.emplace_back(spec.key);
  return left;
}

}  // namespace saccade
