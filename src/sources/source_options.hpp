#pragma once

#include "core/input_settings.hpp"
#include "core/sensor_settings.hpp"

namespace saccade {

/// What a user may say about a source beside its name.
struct SourceOptions {
  SensorSettings sensor{};  ///< of live sensors
  InputSettings input{};    ///< of files
};

}  // namespace saccade
