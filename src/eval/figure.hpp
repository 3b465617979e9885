#pragma once

#include "eval/drawing.hpp"
#include "eval/plan.hpp"
#include "eval/statistics.hpp"

namespace saccade {

/// The Hit Ratio over the number of points, like the paper's figures 6, 7 and 8: for each selector and kernel
/// a panel that compares the models, and for each selector and model on which the kernel has an effect a
/// panel that compares the kernels. With one model only the latter are shown if there are any. Every panel
/// shows the upper bound and the two baselines; the 95 % intervals are shaded unless a panel has too many
/// curves for that.
Drawing draw_hit_ratios(const EvalPlan& plan, const Statistics& statistics);

}  // namespace saccade
