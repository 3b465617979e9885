#include "core/frame_source.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"

namespace saccade {

void check_start(const SourceInfo& source, std::int64_t start) {
  if (source.frame_count && start >= *source.frame_count)
    throw usage_error(fmt::format("--start {} is past the last frame", start), source.uri,
                      fmt::format("it has {}, counted from 0", counted(*source.frame_count, "frame")));
}

}  // namespace saccade
