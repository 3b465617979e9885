#pragma once

#include "core/sensor_controls.hpp"
#include "core/sensor_settings.hpp"

namespace saccade {

/// Copies a change of the sensor's controls into the settings, so that it holds for the next opening, the
/// command line and undo too. `now` are the device's values: its exposure stays when the automatic exposure
/// is switched off; where the device reports none, the automatic exposure stays on.
void store_request(SensorSettings& settings, const SensorValues& wanted, const SensorValues& now);

/// The request to an open sensor that leads from `from` to `to`; all empty = nothing to change. Leaves out
/// the mode, for which the sensor must be opened again.
[[nodiscard]] SensorValues changed_values(const SensorSettings& from, const SensorSettings& to);

}  // namespace saccade
