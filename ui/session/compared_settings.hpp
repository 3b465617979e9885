#pragma once

#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace saccade {

/// The settings that the user tunes: A, and B for comparison.
struct ComparedSettings {
  Settings a, b;
  bool operator==(const ComparedSettings& other) const;
};

/// True if both print the same values for every setting.
[[nodiscard]] bool same_settings(const Settings& a, const Settings& b);

/// Whether A and B have a value each: so for the settings of model and attention. A's value of every other
/// setting, which concerns source or program, holds for both.
[[nodiscard]] bool is_compared(const SettingSpec& spec);

/// Copies the settings that A and B have each (is_compared()); the others stay.
void copy_compared(const Settings& from, Settings& to);

void swap_sides(ComparedSettings& settings);

/// Copies the other settings from A to B.
void share_source(ComparedSettings& settings);

/// Reads a TOML file into A, or into B. Settings that A and B have each and that the file does not mention
/// get their defaults; camera and sensor hold for both sides. Returns the keys in the file that a running
/// window cannot change, such as "workers", and whose values differ from the present ones. Throws as
/// load_settings() and leaves the settings unchanged then.
[[nodiscard]] std::vector<std::string> load_compared(ComparedSettings& settings, bool into_b,
                                                     const std::string& path);

}  // namespace saccade
