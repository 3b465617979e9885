#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds `saccade settings` to `app`; parsing it sets `action` to printing settings as a TOML file.
void add_settings_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
