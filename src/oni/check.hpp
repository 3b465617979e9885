#pragma once

#include "oni/recording.hpp"

namespace saccade {

/// Checks a recording (README 10) and returns its problems in the order of the file: damage that the scan
/// found, frames that do not decode, and whatever makes OpenNI's own players refuse, crash or omit frames.
/// Decodes every frame. The recording is sound if no problem is an error.
OniProblems check_recording(Recording& recording);

inline bool is_sound(const OniProblems& problems) { return problems.count(OniSeverity::error) == 0; }

}  // namespace saccade
