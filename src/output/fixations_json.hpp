#pragma once

#include <string>

#include "pipeline/result.hpp"

namespace saccade {

/// A frame's line of fixations.jsonl (SPEC section 7), without the line feed. Lengths in mm in camera frame;
/// a position of 0, 0, 0 means that there is no depth reading at the pixel. Fixations of `proto` also tell
/// their proto-object; "ended_early" says why there are fewer than were asked for.
std::string fixations_json(const Result& result);

}  // namespace saccade
