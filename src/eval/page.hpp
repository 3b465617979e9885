#pragma once

#include <string>
#include <vector>

#include "eval/contact_sheet.hpp"
#include "eval/statistics.hpp"

namespace saccade {

/// index.html: the figure (`svg`), a table of the means with intervals, what the points lie on, and the
/// examples' pictures, which are files beside the page.
std::string page_html(const EvalPlan& plan, const std::vector<ImageResult>& images,
                      const Statistics& statistics, const std::string& svg,
                      const std::vector<Example>& examples);

}  // namespace saccade
