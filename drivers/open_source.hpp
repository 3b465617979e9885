#pragma once

#include <memory>
#include <string>

#include "pipeline/frame_source.hpp"

namespace saccade {

/// Opens what a user names SOURCE on the command line (SPEC section 7). Throws Error (usage) for a kind of
/// source that is not known, Error (unreadable) for one that cannot be read.
std::unique_ptr<FrameSource> open_source(const std::string& uri);

}  // namespace saccade
