#pragma once

#include <optional>
#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace saccade {

struct EvalArguments {
  std::string dataset;                     ///< as open_source() takes it; its frames need labels
  std::string out;                         ///< folder, made if it does not exist
  std::string models, kernels, selectors;  ///< lists "a,b"; empty = the one of the settings
  std::optional<int> points;               ///< n goes from 1 to this, 1..1000; none = 30, over time 10
  bool over_time = false;                  ///< eval_over_time() instead of eval()
  std::string shard = "1/1";
  std::vector<std::string> merge;   ///< folders of shards; then there is no data set
  bool partial = false;             ///< merge also if some are missing or not complete
  std::vector<std::string> status;  ///< folders of shards to report on; then there is no data set either
};

/// `saccade eval`: the Hit Ratio of every model, kernel and selector on a labelled data set. Each image's
/// result is appended to OUT/results.jsonl as soon as it is known, so that the same command continues an
/// interrupted evaluation; then hr.csv, report.json, hr.svg, hr.png, reliability.svg, reliability.png,
/// index.html and examples/ are written into OUT. Throws Error, also (unfinished) if it was interrupted.
void eval(const EvalArguments& arguments, const Settings& settings);

/// `saccade eval --merge`: the same files from the results of all shards.
void eval_merge(const EvalArguments& arguments, const Settings& settings);

/// `saccade eval --status`: how far each shard is. Throws Error (unfinished) unless all shards are complete.
void eval_status(const EvalArguments& arguments, bool json);

}  // namespace saccade
