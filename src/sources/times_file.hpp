#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace saccade {

/// The times of numbered frames: lines "NUMBER MICROSECONDS", '#' starts a comment. Empty if there is no such
/// file. Throws Error (unreadable) that names a line of another form, or with a time beyond 1e15.
[[nodiscard]] std::map<std::int64_t, std::int64_t> read_times(const std::filesystem::path& file);

}  // namespace saccade
