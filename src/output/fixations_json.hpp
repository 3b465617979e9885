#pragma once

#include <string>

#include "pipeline/result.hpp"

namespace saccade {

/// Version of the format of fixations.jsonl (src/app/README.md, Versions).
inline constexpr int kFixationsFormat = 1;

/// A frame's line of fixations.jsonl (README.md), without the line feed. Positions are in mm in camera frame;
/// 0, 0, 0 means that there is no depth reading at the pixel. Fixations of `proto` also have their confidence
/// and describe their proto-object; "ended_early" says why there are fewer than requested.
/// With attention over time: "gaze" (id or null), "cut", "camera_to_world" (4 x 4, row by row, mm), and of
/// each fixation "id", "age_frames" and "world_mm".
std::string fixations_json(const Result& result);

}  // namespace saccade
