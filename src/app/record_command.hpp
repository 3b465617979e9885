#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds `saccade record` to `app`; parsing it sets `action` to record().
void add_record_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
