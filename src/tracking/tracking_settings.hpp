#pragma once

#include <string>
#include <vector>

#include "attention/attention_settings.hpp"
#include "core/setting.hpp"

namespace saccade {

enum class Tracking {
  automatic,  ///< for sources whose frames are a sequence
  on,
  off,
};

/// How attention holds over time.
struct TrackingSettings {
  Tracking tracking = Tracking::automatic;
  double dwell_s = 0.5;       ///< how long one object is looked at, 0..60
  double return_after_s = 5;  ///< how long after it is not looked at again, 0..3600
  double memory_s = 30;       ///< how long an object that is not seen is remembered, 0..86400
};

std::vector<SettingOf<TrackingSettings>> tracking_setting_specs();

/// Whether attention over time is wanted for a source and possible with a selector. `source`: as its user
/// named it, for the message. Throws Error (usage) if it is asked for with a selector that has no
/// proto-objects.
[[nodiscard]] bool tracks(const TrackingSettings& settings, Selector selector, bool is_sequence,
                          const std::string& source);

}  // namespace saccade
