#pragma once

#include <filesystem>
#include <optional>

#include "core/intrinsics.hpp"

namespace saccade {

/// fx, fy, cx, cy (px) of `folder`/meta.json; std::nullopt if there is no such file or it has none of the
/// four. Throws Error (unreadable): not JSON, some of the four missing, not numbers, or no camera.
std::optional<Intrinsics> read_meta(const std::filesystem::path& folder);

}  // namespace saccade
