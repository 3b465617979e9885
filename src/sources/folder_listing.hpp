#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/intrinsics.hpp"

namespace saccade {

/// One frame of a folder: its files, not yet opened.
struct FolderEntry {
  std::string name;                            ///< "0007", or the time stamp in a TUM folder
  std::int64_t timestamp_us = 0;               ///< from the first frame
  std::filesystem::path depth, colour, label;  ///< colour and label may be empty
  std::filesystem::path classes{};             ///< may be empty
};

struct FolderListing {
  std::string kind;  ///< "folder", "tum" or "osd"
  std::vector<FolderEntry> entries;
  double mm_per_unit = 1;
  double rate_hz = 30;
  std::vector<std::string> notes;
  std::filesystem::path cloud;  ///< an organised point cloud, whose points tell the camera; may be empty
};

/// Finds the frames of any of the layouts. Throws Error (unreadable) if there is no folder or there are no
/// frames in it.
FolderListing list_folder(const std::filesystem::path& folder);

/// fx, fy, cx, cy of `folder`/meta.json; std::nullopt if there is no such file or it has none of the four.
/// Throws Error (unreadable): not JSON, some of the four missing, not numbers, or no camera.
std::optional<Intrinsics> read_meta(const std::filesystem::path& folder);

}  // namespace saccade
