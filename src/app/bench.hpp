#pragma once

#include "settings/settings.hpp"

namespace saccade {

/// `saccade bench`: prints the speed of the operator and of the attention stage on this machine with these
/// settings, the sensor modes that this sustains, and the ratio to the reference implementation, all in one
/// run on a synthetic table with the noise of a Kinect. A mode is sustained if 95 of 100 frames are finished
/// within their period. `seconds` is the time spent on each size. Uses the settings of model and attention,
/// json and workers. Throws Error (usage) if no size has room for the levels.
void bench(const Settings& settings, double seconds);

}  // namespace saccade
