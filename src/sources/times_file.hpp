#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace saccade {

/// How far from 0 times in files may be, 30 years: sums and differences of them do not overflow.
inline constexpr std::int64_t kFarthestTime_us = 1'000'000'000'000'000;

/// The times of numbered frames: lines "NUMBER MICROSECONDS", '#' starts a comment. Empty if there is no such
/// file. Throws Error (unreadable) that names a line of another form, or with a time beyond kFarthestTime_us.
[[nodiscard]] std::map<std::int64_t, std::int64_t> read_times(const std::filesystem::path& file);

}  // namespace saccade
