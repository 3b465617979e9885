#include "app/options.hpp"

namespace saccade {

SettingsOptions::SettingsOptions(CLI::App& command, const std::set<std::string_view>& left_out) {
  command.add_option("--config", config_, "TOML file of settings; options of the command line come over it")
      ->type_name("FILE");
  for (const SettingSpec& spec : setting_specs()) {
    if (left_out.contains(spec.key)) continue;
    const std::string key(spec.key);
    const std::string help = std::string(spec.help) + " [" + spec.print(Settings{}) + "]";
    if (spec.is_switch())
      add_switch(command, spec);
    else
      command
          .add_option_function<std::string>(
              "--" + key, [this, key](const std::string& value) { given_.emplace_back(key, value); }, help)
          ->type_name(std::string(spec.value));
  }
}

// One that is on unless a person says otherwise is offered as --no-KEY too.
void SettingsOptions::add_switch(CLI::App& command, const SettingSpec& spec) {
  const std::string key(spec.key);
  const bool on = spec.print(Settings{}) == "true";
  command.add_flag_function(
      "--" + key + (on ? ",!--no-" + key : ""),
      [this, key](std::int64_t count) { given_.emplace_back(key, count > 0 ? "true" : "false"); },
      std::string(spec.help) + (on ? " [on]" : ""));
}

Settings SettingsOptions::resolve(const Settings& base) const {
  Settings settings = base;
  if (!config_.empty()) load_settings(settings, config_);
  for (const auto& [key, value] : given_) apply_setting(settings, key, value);
  return settings;
}

std::set<std::string_view> sensor_keys_and(std::set<std::string_view> also) {
  also.insert(kSensorKeys.begin(), kSensorKeys.end());
  return also;
}

}  // namespace saccade
