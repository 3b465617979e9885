#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace saccade {

/// Describes the program to `app` and adds every command. Parsing sets `action` to the work of the command
/// that was given; it stays empty if there was none. `command_line` is noted in manifests.
void add_commands(CLI::App& app, std::function<void()>& action, const std::vector<std::string>& command_line);

}  // namespace saccade
