#pragma once

#include "app/eval.hpp"

namespace saccade {

/// `saccade eval --over-time`: how attention over time holds on a sequence whose labels keep their identity,
/// or whose camera poses are known, for every model. OUT gets over_time.json, over_time.svg and
/// over_time.png. Throws Error, also if it was interrupted.
void eval_over_time(const EvalArguments& arguments, const Settings& settings);

}  // namespace saccade
