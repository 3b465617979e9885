#pragma once

#include <optional>
#include <string>

#include "pipeline/playback_controls.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// A word for a POSIX shell: in single quotes if it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

/// How a shell starts this program: "saccade" where that finds it, else its path.
[[nodiscard]] std::string program_word();

/// The headless command that computes these frames of a recording (none = a sensor, from now on) with these
/// settings: `PROGRAM run SOURCE --out out/view ...` with every setting that is not the default.
[[nodiscard]] std::string run_command_line(const std::string& program, const std::string& source,
                                           const Settings& settings, const std::optional<PlayRange>& frames);

}  // namespace saccade
