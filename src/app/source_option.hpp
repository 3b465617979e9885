#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds the positional argument `name`, a source as open_source() takes it, and the table of sources at the
/// end of the command's help.
CLI::Option* add_source_option(CLI::App& command, const std::string& name, std::string& value,
                               const std::string& help);

}  // namespace saccade
