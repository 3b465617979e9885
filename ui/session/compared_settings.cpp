#include "ui/session/compared_settings.hpp"

#include <algorithm>
#include <utility>

namespace saccade {

bool is_compared(const SettingSpec& spec) {
  return spec.scope == SettingScope::model || spec.scope == SettingScope::attention;
}

bool same_settings(const Settings& a, const Settings& b) {
  const auto specs = setting_specs();
  return std::all_of(specs.begin(), specs.end(), [&](const SettingSpec& spec) {
    return spec.print(a) == spec.print(b) && (!spec.chosen || spec.chosen(a) == spec.chosen(b));
  });
}

bool ComparedSettings::operator==(const ComparedSettings& other) const {
  return same_settings(a, other.a) && same_settings(b, other.b);
}

void copy_compared(const Settings& from, Settings& to) {
  static_cast<ModelSettings&>(to) = from;
  static_cast<AttentionSettings&>(to) = from;
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
  copy_compared(loaded, into_b ? settings.b : settings.a);
  share_source(settings);
  std::vector<std::string> left;
  for (const SettingSpec& spec : setting_specs())
    if (!is_compared(spec) && spec.print(loaded) != spec.print(settings.a)) left.emplace_back(spec.key);
  return left;
}

}  // namespace saccade
