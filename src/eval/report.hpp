#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "eval/statistics.hpp"

namespace saccade {

/// hr.csv: a line for each evaluated image, condition and n, in this order; names are quoted where they must
/// be (RFC 4180).
std::string csv_text(const EvalPlan& plan, const std::vector<ImageResult>& images);

/// report.json. Only its "times_ms" depend on the machine and how busy it was.
nlohmann::ordered_json report_json(const EvalPlan& plan, const std::vector<ImageResult>& images,
                                   const Statistics& statistics);

/// A table of the means at shown_counts() for a terminal.
std::string report_text(const EvalPlan& plan, const Statistics& statistics);

}  // namespace saccade
