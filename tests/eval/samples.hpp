#pragma once

#include <vector>

#include "eval/evaluator.hpp"
#include "eval/plan.hpp"

namespace saccade {

/// A plan of one model with kernels 10 and 15, both selectors and 3 points, on 3 frames.
EvalPlan sample_plan();

/// Hand-made results of it: frame 0 with two objects, frame 1 left out, frame 2, "a,\"b\"", with one.
std::vector<ImageResult> sample_images();

}  // namespace saccade
