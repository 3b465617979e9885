#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// Where the bundled recording is, seen from the program's file: in the installed data (share/saccade), or in
/// recordings/ of a folder above (a build tree). Empty if it is in neither.
std::filesystem::path find_bundled_recording(const std::filesystem::path& program);

/// Adds `saccade view` to `app`; parsing it sets `action` to what it does.
void add_view_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
