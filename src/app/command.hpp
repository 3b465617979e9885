#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/frame_source.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// Sets which messages are printed: those of settings.log_level, or warnings and errors only if quiet.
void set_log_level(const Settings& settings);

/// Warns of a source's notes, and of a camera that is only guessed.
void report_notes(const SourceInfo& source, const Settings& settings);

/// Reports that a live source's device was lost or reconnected, and the settings that it did not apply. That
/// the source waits for a device at the start is reported on a terminal only: if none comes, the error says
/// so. Any thread.
void report_state(const SourceState& state);

/// Cuts the default levels to those that the source's images have room for, and adds a note about it to the
/// source. Levels that the user chose stay; check_levels() refuses them if they do not fit.
void fit_default_levels(Settings& settings, SourceInfo& source);

/// For a source without depth: throws Error (usage) if the model needs depth, and replaces the selector
/// `proto`, which needs it too, by `wta`, adding a note about it to the source.
void fit_to_depth(Settings& settings, SourceInfo& source);

/// The number of frames to come, if that can be known.
std::optional<std::int64_t> expected_frames(const SourceInfo& source, const FrameSettings& settings);

/// Makes the folder of --out if it does not exist. Throws Error (failed).
void make_output_folder(const std::filesystem::path& folder);

}  // namespace saccade
