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
      command.add_flag_callback(
          "--" + key, [this, key] { given_.emplace_back(key, "true"); }, std::string(spec.help));
    else
      command
          .add_option_function<std::string>(
              "--" + key, [this, key](const std::string& value) { given_.emplace_back(key, value); }, help)
          ->type_name(std::string(spec.value));
  }
}

Settings SettingsOptions::resolve(const Settings& base) const {
  Settings settings = base;
  if (!config_.empty()) load_settings(settings, config_);
  for (const auto& [key, value] : given_) apply_setting(settings, key, value);
  return settings;
}

}  // namespace saccade
