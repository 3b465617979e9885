#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "settings/settings.hpp"

namespace saccade {

struct RunArguments {
  std::string source;                     ///< SOURCE of SPEC section 7
  std::string out;                        ///< folder, made if it is not there
  std::vector<std::string> command_line;  ///< for the manifest
};

/// `saccade run`: computes every frame of the source and writes DIR (SPEC section 7). Throws Error.
void run(const RunArguments& arguments, const Settings& settings);

/// Adds the command to `app`; parsing it sets `action` to what it does. `command_line` goes into the
/// manifest.
void add_run_command(CLI::App& app, std::function<void()>& action, std::vector<std::string> command_line);

}  // namespace saccade
