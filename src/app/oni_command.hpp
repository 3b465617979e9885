#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// `saccade oni info`: what is in a recording, as text or (json) as one JSON object. Throws Error.
void oni_info(const std::string& file, bool json);

/// `saccade oni check`: every problem with its position and meaning. Throws Error (unreadable) after printing
/// them if the recording is not sound, and at once if it is no recording at all.
void oni_check(const std::string& file, bool json);

/// `saccade oni repair`: writes the good frames of `file` to the new file `to`; if that is empty, beside the
/// original as NAME.repaired.oni. Throws Error.
void oni_repair(const std::string& file, const std::string& to, bool force, bool json);

/// Adds the subcommand with its three; when one is given, parsing sets `action` to what it does.
void add_oni_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
