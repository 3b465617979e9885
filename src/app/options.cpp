#include "app/options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"

namespace saccade {
namespace {

bool holds(const std::vector<std::string_view>& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

bool AcceptedSettings::contains(const SettingSpec& spec) const {
  const bool in_scope = std::find(scopes.begin(), scopes.end(), spec.scope) != scopes.end();
  return (in_scope || holds(also, spec.key)) && !holds(except, spec.key);
}

SettingsOptions::SettingsOptions(CLI::App& command, const AcceptedSettings& accepted)
    : command_(command.get_name()), accepted_(accepted) {
  command.add_option("--config", config_, "TOML file of settings; options on the command line override it")
      ->type_name("FILE");
  const Settings defaults;
  for (const SettingSpec& spec : setting_specs()) {
    CLI::Option& option = *add(command, spec, spec.print(defaults));
    // Hidden, but known, so that resolve() can say that it is not accepted.
    option.group(accepted.contains(spec) ? std::string(title(spec.scope)) : "");
  }
}

CLI::Option* SettingsOptions::add(CLI::App& command, const SettingSpec& spec,
                                  const std::string& default_text) {
  const std::string name = "--" + std::string(spec.key);
  const bool on = default_text == "true";  // then --no-KEY switches it off
  if (spec.is_switch())
    return command.add_flag_function(
        name + (on ? ",!--no-" + std::string(spec.key) : ""),
        [this, &spec](std::int64_t count) { given_.emplace_back(&spec, count > 0 ? "true" : "false"); },
        spec.help + (on ? " [on]" : ""));
  return command
      .add_option_function<std::string>(
          name, [this, &spec](const std::string& value) { given_.emplace_back(&spec, value); },
          spec.help + " [" + default_text + "]")
      ->type_name(std::string(spec.value));
}

Settings SettingsOptions::resolve(const Settings& base) const {
  for (const auto& [spec, value] : given_)
    if (!accepted_.contains(*spec))
      throw usage_error(fmt::format("{} does not accept this setting", command_),
                        fmt::format("--{}", spec->key), fmt::format("see saccade {} --help", command_));
  Settings settings = base;
  if (!config_.empty()) load_settings(settings, config_);
  for (const auto& [spec, value] : given_) apply_setting(settings, spec->key, value);
  return settings;
}

}  // namespace saccade
