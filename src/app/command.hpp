#pragma once

#include <filesystem>

#include "core/frame_source.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// Sets what is logged: settings.log_level, or warnings and errors only if it is to be quiet.
void set_log_level(const Settings& settings);

/// Warns of what the user should know of a source: its notes, and a camera that is guessed.
void tell_notes(const SourceInfo& source, const Settings& settings);

/// Tells that a live source's device is lost, or streams again, and what it does otherwise than asked. That
/// it is waited for at the start is told on a terminal only: if none comes, the error says so. Any thread.
void tell_state(const SourceState& state);

/// Cuts the default levels to those that the source's images have room for, and adds a note of it to the
/// source. Levels that the user chose stay; check_levels() refuses them if they do not fit.
void fit_default_levels(Settings& settings, SourceInfo& source);

/// For a source without depth: throws Error (usage) if the model works on depth, and exchanges the selector
/// `proto`, which does too, for `wta`, adding a note of it to the source.
void fit_to_depth(Settings& settings, SourceInfo& source);

/// Makes the folder of --out if it is not there. Throws Error (failed).
void make_output_folder(const std::filesystem::path& folder);

}  // namespace saccade
