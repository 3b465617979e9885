#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds `saccade eval` to `app`; parsing it sets `action` to eval() or eval_merge().
void add_eval_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
