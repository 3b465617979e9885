#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// The manual page in roff of the program, or of one of its commands, made from its table of options.
/// `program` has the names of both.
[[nodiscard]] std::string man_page(const CLI::App& program, const CLI::App& command);

/// The name of that page: "saccade", or "saccade-run".
[[nodiscard]] std::string man_page_name(const CLI::App& program, const CLI::App& command);

/// Whether help and completion show this option: hidden ones are in no group.
[[nodiscard]] bool is_shown(const CLI::Option& option);

/// The commands of the program, or of a command.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& app);

}  // namespace saccade
