#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "settings/settings.hpp"

namespace saccade {

/// `saccade bench`: how fast the operator and the attention stage are on this machine with these settings,
/// which sensor modes that sustains, and how much faster it is than the readable reference, all in one run on
/// a synthetic table with the noise of a Kinect. A mode is sustained if 95 of 100 frames are done within
/// their period. `seconds` is the time spent on each size. Throws Error (usage) if no size has room for the
/// settings' levels.
void bench(const Settings& settings, double seconds);

/// Adds the subcommand; when it is given, parsing sets `action` to what it does.
void add_bench_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
