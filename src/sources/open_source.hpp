#pragma once

#include <memory>
#include <string>

#include "core/frame_source.hpp"
#include "core/sensor_settings.hpp"

namespace saccade {

/// Opens what a user names SOURCE on the command line (SPEC section 7). Throws Error (usage) for a kind of
/// source that is not known, Error (unreadable) for one that cannot be read.
/// `sensor` is for live sensors only.
std::unique_ptr<FrameSource> open_source(const std::string& uri, const SensorSettings& sensor = {});

}  // namespace saccade
