#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace saccade {

/// A value of the setting that is not the default.
inline std::string other_value(const SettingSpec& spec) {
  std::vector<std::string> candidates = spec.words;
  for (const char* text : {"true", "false", "3", "7", "0.7", "1..3", "400,401,300,200", "320x240@60", "fixed",
                           "none", "-", "depth=/a"})
    candidates.emplace_back(text);
  for (const std::string& text : candidates) try {
      Settings settings;
      spec.parse(settings, text);
      if (!is_default(spec, settings)) return text;
    } catch (const std::invalid_argument&) {
      // not a value of this setting
    }
  throw std::logic_error("no other value is known of " + std::string(spec.key));
}

/// The default settings except for this one.
inline Settings changed(const SettingSpec& spec) {
  Settings settings;
  spec.parse(settings, other_value(spec));
  return settings;
}

}  // namespace saccade
