#pragma once

#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace saccade {

/// The settings that a person tunes: A's, and B's for comparison.
struct ComparedSettings {
  Settings a, b;
  bool operator==(const ComparedSettings& other) const;
};

/// True if both print the same values for every setting.
bool same_settings(const Settings& a, const Settings& b);

/// Whether A and B have the setting each for itself: those of model and attention. A's value of every other
/// one, which concerns source and program, holds for both.
bool is_compared(const SettingSpec& spec);

/// Makes the tuned settings of `to` those of `from`; the others stay.
void copy_compared(const Settings& from, Settings& to);

void swap_sides(ComparedSettings& settings);

/// Makes all settings of B that are not tuned those of A.
void share_source(ComparedSettings& settings);

/// Reads a TOML file into A, or into B: what the file does not say of the tuned settings becomes the default;
/// what it says of camera and sensor holds for both sides. Returns the keys of the file that say something
/// else than what holds and that a window does not take up while it runs, such as "workers". Throws as
/// load_settings(); the settings are then as they were.
std::vector<std::string> load_compared(ComparedSettings& settings, bool into_b, const std::string& path);

}  // namespace saccade
