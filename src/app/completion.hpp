#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// The completion scripts of two shells, made from the program's tables of commands, options and settings.
[[nodiscard]] std::string bash_completion(const CLI::App& program);
[[nodiscard]] std::string zsh_completion(const CLI::App& program);

}  // namespace saccade
