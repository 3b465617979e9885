#pragma once

#include <string>
#include <vector>

#include "eval/contact_sheet.hpp"
#include "eval/statistics.hpp"

namespace saccade {

/// SVG documents; `reliability` is empty if no point has a confidence.
struct PageFigures {
  std::string hit_ratios, reliability;
};

/// index.html: the figures, a table of the means with intervals, what the points lie on, how reliable their
/// confidence is, and the examples' pictures, which are files beside the page.
std::string page_html(const EvalPlan& plan, const Statistics& statistics, const PageFigures& figures,
                      const std::vector<Example>& examples);

}  // namespace saccade
