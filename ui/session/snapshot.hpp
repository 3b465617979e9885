#pragma once

#include <chrono>
#include <filesystem>

#include "ui/session/view_result.hpp"

namespace saccade {

/// Writes what is on screen into a new folder `base`/snapshot-YYYYMMDD-HHMMSS of local time (with -2, -3, ...
/// if that is taken): NNNNNN_overlay.png in `style`, NNNNNN_saliency.tiff and .png as `saccade run` writes
/// them, NNNNNN_fixations.json, the frame's line of fixations.jsonl, and settings.toml, with which `saccade
/// run
/// --config` computes the same. Of a comparison these are in its folders a/ and b/. Returns the folder. Takes
/// some 100 ms: not for the thread that draws. Throws Error (failed).
std::filesystem::path write_snapshot(const std::filesystem::path& base, const ViewResult& result,
                                     const OverlayStyle& style, std::chrono::system_clock::time_point now);

/// A name for a file or folder that is new in `base`: stem + time + ending, with -2, -3, ... before the
/// ending if that is taken.
std::filesystem::path unused_path(const std::filesystem::path& base, const std::string& stem,
                                  const std::string& ending, std::chrono::system_clock::time_point now);

}  // namespace saccade
