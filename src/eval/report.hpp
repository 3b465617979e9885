#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "eval/statistics.hpp"

namespace saccade {

/// hr.csv: its first line, and the lines of an image, one for each condition and n, in this order; none for
/// an image that is left out. Names are quoted where RFC 4180 requires it. `void` and `hr_void_neutral` are
/// empty for an image without classes.
std::string csv_head();
std::string csv_lines(const EvalPlan& plan, const ImageResult& image);

/// report.json. Only its "times_ms" depend on the machine and its load.
nlohmann::ordered_json report_json(const EvalPlan& plan, const Statistics& statistics);

/// The means at shown_counts() and what the points lie on, as tables for a terminal.
std::string report_text(const EvalPlan& plan, const Statistics& statistics);

}  // namespace saccade
