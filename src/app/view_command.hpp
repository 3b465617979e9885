#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// The path of the bundled recording, given that of the program: in the installed data (share/saccade), or in
/// recordings/ of a folder above the program (a build tree). Empty if it is in neither.
std::filesystem::path find_bundled_recording(const std::filesystem::path& program);

/// Adds `saccade view` to `app`; parsing it sets `action` to the viewer.
void add_view_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
