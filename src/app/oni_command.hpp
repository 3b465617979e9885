#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace saccade {

/// `saccade oni info`: prints what a recording holds, as text or as one JSON object. Throws Error.
void oni_info(const std::string& file, bool json);

/// `saccade oni check`: prints every problem of a recording with its position and meaning. Throws Error
/// (unreadable) after that if the recording is not sound, and at once if the file is no recording.
void oni_check(const std::string& file, bool json);

/// `saccade oni repair`: copies the good frames of `file` to the new file `to`, or if that is empty to
/// NAME.repaired.oni beside the original. Throws Error.
void oni_repair(const std::string& file, const std::string& to, bool force, bool json);

/// `saccade oni cut`: copies the piece "FROM..TO" (parse_piece()) of `file` to the new file `to`. Throws
/// Error.
void oni_cut(const std::string& file, const std::string& piece, const std::string& to, bool force, bool json);

/// Adds `saccade oni` with its four subcommands to `app`; parsing one sets `action` to it.
void add_oni_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
