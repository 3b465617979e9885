#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds `saccade export` to `app`; parsing it sets `action` to export_frames().
void add_export_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
