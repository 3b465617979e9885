#pragma once

#include <optional>

#include "eval/drawing.hpp"
#include "eval/plan.hpp"
#include "eval/statistics.hpp"

namespace saccade {

/// The reliability diagram: over the confidence of the points of each bin (its mean), the share of them that
/// lies on objects. A perfect confidence lies on the diagonal. Bins with fewer than kFewestInBin points are
/// left out. None if no condition has confidences.
std::optional<Drawing> draw_reliability(const EvalPlan& plan, const Statistics& statistics);

inline constexpr std::size_t kFewestInBin = 5;

}  // namespace saccade
