#pragma once

#include <cstdint>
#include <string>

#include "pipeline/frame_settings.hpp"

namespace saccade {

inline constexpr int kMostShards = 100'000;

/// The index-th of `count` parts of a job, counted from 1.
struct Shard {
  int index = 1, count = 1;
};

/// "i/n" with 1 <= i <= n <= kMostShards. Throws Error (usage).
[[nodiscard]] Shard parse_shard(const std::string& text);

/// Selects one part of the frames that `settings` selects of a source with `count` frames. The parts follow
/// one another and differ by one frame at most. Throws Error (usage) if there are fewer frames than parts.
[[nodiscard]] FrameSettings part_of(const FrameSettings& settings, std::int64_t count, const Shard& shard);

}  // namespace saccade
