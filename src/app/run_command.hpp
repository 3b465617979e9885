#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds `saccade run` to `app`; parsing it sets `action` to run(). `command_line` goes into the manifest.
void add_run_command(CLI::App& app, std::function<void()>& action, std::vector<std::string> command_line);

}  // namespace saccade
