#include "pipeline/shard.hpp"

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"

namespace saccade {

Shard parse_shard(const std::string& text) {
  const std::string_view view = text;
  const std::size_t slash = view.find('/');
  try {
    if (slash == std::string_view::npos) throw std::invalid_argument("no /");
    const int count = parse_number(view.substr(slash + 1), 1, kMostShards, "");
    return {parse_number(view.substr(0, slash), 1, count, ""), count};
  } catch (const std::invalid_argument&) {
    throw usage_error("bad value for shard", fmt::format("'{}'", text),
                      fmt::format("expected i/n with 1 <= i <= n <= {}, e.g. 3/8", kMostShards));
  }
}

FrameSettings part_of(const FrameSettings& settings, std::int64_t count, const Shard& shard) {
  const std::int64_t all = selected_frames(settings, count);
  if (all < shard.count)
    throw usage_error(fmt::format("{} cannot be divided into {} shards", counted(all, "frame"), shard.count),
                      "--shard", "use fewer shards");
  const std::int64_t begin = all * (shard.index - 1) / shard.count, end = all * shard.index / shard.count;
  FrameSettings part = settings;
  part.start = settings.start + begin * settings.every;
  part.frames = end - begin;
  return part;
}

}  // namespace saccade
