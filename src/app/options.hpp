#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "settings/settings.hpp"

namespace saccade {

/// Which settings a command accepts as options: those of some scopes, and some keys of other scopes, without
/// some keys.
struct AcceptedSettings {
  std::vector<SettingScope> scopes;
  std::vector<std::string_view> also{}, except{};

  bool contains(const SettingSpec& spec) const;
};

/// The settings as options --key of one command, in the groups of their scopes, and --config FILE. The file
/// is read first and the options are laid over it, wherever they stand on the command line.
class SettingsOptions {
 public:
  /// Adds the options to `command`, which must not outlive this. A file may also hold the settings that the
  /// command does not accept.
  SettingsOptions(CLI::App& command, const AcceptedSettings& accepted);

  /// After parsing: `base`, then the file, then the options. Throws Error (usage or unreadable), also for an
  /// option that is a setting which the command does not accept.
  [[nodiscard]] Settings resolve(const Settings& base = {}) const;

 private:
  CLI::Option* add(CLI::App& command, const SettingSpec& spec, const std::string& default_text);

  std::string command_, config_;
  std::vector<std::pair<const SettingSpec*, std::string>>
      given_;  // setting and value, in their order on the command line
  AcceptedSettings accepted_;
};

}  // namespace saccade
