#pragma once

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/settings.hpp"

namespace saccade {

/// The settings as options of one subcommand: every SettingSpec as --key, and --config FILE. The file is read
/// first and the options are laid over it, wherever they stand on the command line.
class SettingsOptions {
 public:
  /// Adds the options to `command`, which must not outlive this, except for the keys `left_out`: a file may
  /// hold these too.
  explicit SettingsOptions(CLI::App& command, const std::set<std::string_view>& left_out = {});

  /// After parsing: `base`, then the file, then the options. Throws Error (usage or unreadable).
  Settings resolve(const Settings& base = {}) const;

 private:
  void add_switch(CLI::App& command, const SettingSpec& spec);

  std::string config_;
  std::vector<std::pair<std::string, std::string>>
      given_;  // key and value, in their order on the command line
};

/// The keys of live sensors and `also`: what a command without a live source leaves out.
std::set<std::string_view> sensor_keys_and(std::set<std::string_view> also);

}  // namespace saccade
