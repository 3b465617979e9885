#pragma once

#include "oni/recording.hpp"

namespace saccade {

/// Everything that is wrong with a recording, in the order of the file: what the scan found, frames that do
/// not decode, and what would make OpenNI's own players refuse, crash or leave out frames. The recording is
/// sound if no problem is an error.
OniProblems check_recording(Recording& recording);

inline bool is_sound(const OniProblems& problems) { return problems.count(OniSeverity::error) == 0; }

}  // namespace saccade
