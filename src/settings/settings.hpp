#pragma once

#include <span>
#include <string>
#include <string_view>

#include "attention/attention_settings.hpp"
#include "core/input_settings.hpp"
#include "core/sensor_settings.hpp"
#include "core/setting.hpp"
#include "models/model_settings.hpp"
#include "output/output_settings.hpp"
#include "pipeline/frame_settings.hpp"
#include "settings/program_settings.hpp"
#include "tracking/tracking_settings.hpp"

namespace saccade {

/// Everything a user can set, with its default. Each part belongs to the room that it configures, and that
/// room's functions take their own part. The same names are the options of the command line and the keys of a
/// TOML file; setting_specs() is the one list of them.
struct Settings : ModelSettings,
                  AttentionSettings,
                  TrackingSettings,
                  FrameSettings,
                  InputSettings,
                  OutputSettings,
                  ProgramSettings {
  SensorSettings sensor;  ///< a member, since names such as `mode` say too little without it
};

/// What a setting is about. From it follow which commands accept the setting, its group in --help, whether
/// the two sides of the viewer's comparison have it each for itself, whether a computed map or attention
/// points become stale when it changes, and whether an evaluation keeps it in its plan.
enum class SettingScope {
  model,      ///< changes maps
  attention,  ///< changes attention points
  tracking,   ///< changes how attention holds over time
  frames,     ///< selects or describes frames
  sensor,     ///< of live sources
  output,     ///< what is written
  program,    ///< how the program runs; changes no result
};

/// "Model", "Attention", ...: the group's title in the help.
std::string_view title(SettingScope scope);

struct SettingSpec : SettingOf<Settings> {
  SettingScope scope;
};

/// All settings in the order of the help, scope by scope.
std::span<const SettingSpec> setting_specs();

/// Throws Error (usage) for an unknown key, naming the nearest known one.
const SettingSpec& setting_spec(std::string_view key);

/// Sets one by name. Throws Error (usage): unknown key, or a value out of range.
void apply_setting(Settings& settings, std::string_view key, const std::string& value);

/// Whether the setting has its default and was not chosen explicitly (SettingOf::chosen).
bool is_default(const SettingSpec& spec, const Settings& settings);

/// Whether every setting of `scope` has the same value in both. Whether it was chosen explicitly does not
/// matter.
bool same_values(SettingScope scope, const Settings& a, const Settings& b);

/// Reads a TOML file of settings over `settings`. Throws Error (usage) for a syntax error, an unknown key or
/// a bad value, naming file and line; Error (unreadable) for a file that cannot be read.
void load_settings(Settings& settings, const std::string& path);

/// The settings that differ from the default as a TOML file that load_settings() reads.
[[nodiscard]] std::string settings_toml(const Settings& settings);

}  // namespace saccade
