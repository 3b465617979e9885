#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/intrinsics.hpp"

namespace saccade {

/// What a meta.json says of the images in its folder. Each part may be absent.
struct FolderMeta {
  std::optional<Intrinsics> camera;     ///< fx, fy, cx, cy (px)
  std::optional<double> depth_unit_mm;  ///< depth_unit_mm, or by depth_scale (see README)
  std::optional<double> rate_hz;
  std::optional<bool> sequence;    ///< as in SourceInfo
  std::vector<std::string> notes;  ///< how depth_scale was understood
};

/// Reads `folder`/meta.json; nothing if there is no such file. Throws Error (unreadable): not JSON, some of
/// the four numbers of a camera are missing, a value is not of its kind or out of range.
FolderMeta read_meta(const std::filesystem::path& folder);

/// The same of a JSON file of any name.
FolderMeta read_meta_file(const std::filesystem::path& file);

}  // namespace saccade
