#pragma once

#include <cstdint>
#include <string>

#include "settings/settings.hpp"

namespace saccade {

/// A word for a POSIX shell: in single quotes if it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

/// The headless command that computes frame `index` of a source (or the source from now on, if `index` < 0)
/// with these settings: `saccade run SOURCE --out out/view ...` with every setting that is not the default.
[[nodiscard]] std::string run_command_line(const std::string& source, const Settings& settings,
                                           std::int64_t index);

}  // namespace saccade
