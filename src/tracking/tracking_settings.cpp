#include "tracking/tracking_settings.hpp"

#include "core/error.hpp"

namespace saccade {

std::vector<SettingOf<TrackingSettings>> tracking_setting_specs() {
  using S = TrackingSettings;
  return {
      enum_setting<S>(
          "tracking",
          "attention over time, objects with ids: auto (on for sensors, recordings and videos), on or "
          "off; needs the selector proto",
          &S::tracking, {"auto", "on", "off"}),
      number_setting<S>("dwell", "S", "how long the gaze rests on one object, seconds, 0..60", &S::dwell_s, 0,
                        60),
      number_setting<S>("return-after", "S",
                        "how long after it has left an object the gaze may return to it, seconds, 0..3600",
                        &S::return_after_s, 0, 3600),
      number_setting<S>("memory", "S", "how long an object out of sight is remembered, seconds, 0..86400",
                        &S::memory_s, 0, 86400),
  };
}

bool tracks(const TrackingSettings& settings, Selector selector, bool is_sequence,
            const std::string& source) {
  if (settings.tracking == Tracking::off) return false;
  if (settings.tracking == Tracking::automatic) return is_sequence && selector == Selector::proto;
  if (selector != Selector::proto)
    throw usage_error("attention over time needs objects, which the selector wta does not find", source,
                      "use --selector proto and a source with depth, or --tracking off");
  return true;
}

}  // namespace saccade
