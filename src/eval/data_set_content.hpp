#pragma once

#include <string>

#include "core/frame_source.hpp"
#include "eval/plan.hpp"

namespace saccade {

/// 16 hexadecimal digits that identify the content of a data set wherever it lies: the size and number of its
/// frames, and depth and labels of the first, middle and last frame that `plan` selects. Reads these frames.
/// Throws Error as FrameSource::read().
[[nodiscard]] std::string data_set_content(FrameSource& source, const EvalPlan& plan);

}  // namespace saccade
