#include "ui/session/command_line.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <sstream>
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

std::string program_word() {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path self = fs::read_symlink("/proc/self/exe", code);
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path found = fs::path(folder) / "saccade";
    if (!fs::exists(found, code)) continue;
    return fs::equivalent(found, self, code) ? "saccade" : self.string();
  }
  return self.string();
}

std::string run_command_line(const std::string& program, const std::string& source, const Settings& settings,
                             const std::optional<PlayRange>& frames) {
  Settings shown = settings;
  if (frames) {
    shown.start = frames->start;
    shown.frames = frames->limit;
    shown.every = frames->every;
  }
  // Settings of the window's own run do not belong into the command.
  shown.json = shown.quiet = false;
  shown.log_level = Settings{}.log_level;
  std::string line = shell_word(program) + " run " + shell_word(source) + " --out out/view";
  for (const SettingSpec& spec : setting_specs()) {
    if (is_default(spec, shown)) continue;
    const std::string key(spec.key), value = spec.print(shown);
    if (spec.is_switch())
      line += value == "true" ? " --" + key : " --no-" + key;
    else
      line += " --" + key + " " + shell_word(value);
  }
  return line;
}

}  // namespace saccade
