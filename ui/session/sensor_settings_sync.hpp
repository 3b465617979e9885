#pragma once

#include "core/sensor_controls.hpp"
#include "core/sensor_settings.hpp"

namespace saccade {

/// Puts what a person asked for at a sensor's controls into the settings, so that it holds for the next
/// opening, the command line and undo too. `now` is what the device says: its exposure is what remains when
/// the automatic one is switched off; where it says none, that cannot be switched off.
void take_request(SensorSettings& settings, const SensorValues& wanted, const SensorValues& now);

/// What an open sensor must be asked for so that `to` holds where `from` did; all empty = nothing. The mode
/// is none of it: it needs another opening.
SensorValues changed_values(const SensorSettings& from, const SensorSettings& to);

}  // namespace saccade
