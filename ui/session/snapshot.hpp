#pragma once

#include <chrono>
#include <filesystem>

#include "ui/session/view_result.hpp"

namespace saccade {

/// Writes the result on screen into a new folder `base`/snapshot-YYYYMMDD-HHMMSS of local time (with -2, -3,
/// ... if that exists): NNNNNN_overlay.png in `style`; depth, colour, point cloud and map as `saccade run`
/// writes them, NNNNNN_fixations.json (the frame's line of fixations.jsonl), and settings.toml, with which
/// `saccade run --config` computes the same; for a comparison in subfolders a/ and b/. Returns the folder.
/// Takes some 100 ms: not for the thread that draws. Throws Error (failed).
[[nodiscard]] std::filesystem::path write_snapshot(const std::filesystem::path& base,
                                                   const ViewResult& result, const OverlayStyle& style,
                                                   std::chrono::system_clock::time_point now);

/// A path in `base` that does not exist: stem + time + ending, with -2, -3, ... before the ending if needed.
[[nodiscard]] std::filesystem::path unused_path(const std::filesystem::path& base, const std::string& stem,
                                                const std::string& ending,
                                                std::chrono::system_clock::time_point now);

}  // namespace saccade
