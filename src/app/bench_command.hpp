#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace saccade {

/// Adds `saccade bench` to `app`; parsing it sets `action` to bench().
void add_bench_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
