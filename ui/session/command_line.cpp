#include "ui/session/command_line.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace saccade {

std::string shell_word(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-_./:=,+@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string run_command_line(const std::string& source, const Settings& settings, std::int64_t index) {
  Settings shown = settings;
  if (index >= 0) {
    shown.start = index;
    shown.frames = 1;
    shown.every = 1;
  }
  // Settings of the window's own run do not belong into the command.
  shown.json = shown.quiet = false;
  shown.log_level = Settings{}.log_level;
  std::string line = "saccade run " + shell_word(source) + " --out out/view";
  for (const SettingSpec& spec : setting_specs()) {
    if (is_default(spec, shown)) continue;
    const std::string value = spec.print(shown);
    line += " --" + std::string(spec.key) + (spec.is_switch() ? "" : " " + shell_word(value));
  }
  return line;
}

}  // namespace saccade
