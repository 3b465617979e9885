#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "settings/settings.hpp"

namespace saccade {

struct EvalArguments {
  std::string dataset;                     ///< SOURCE of SPEC section 7 with labels
  std::string out;                         ///< folder, made if it is not there
  std::string models, kernels, selectors;  ///< lists "a,b"; empty = the one of the settings
  int points = 30;                         ///< n goes from 1 to this, 1..1000
  std::string shard = "1/1";
  std::vector<std::string> merge;  ///< folders of shards; then there is no data set
};

/// `saccade eval`: the Hit Ratio of every model, kernel and selector on a labelled data set. Each image's
/// result is kept in OUT/results.jsonl as soon as it is there, so that the same command goes on where it was
/// interrupted; then OUT gets hr.csv, report.json, hr.svg, hr.png, index.html and examples/. Throws Error,
/// also if it was interrupted.
void eval(const EvalArguments& arguments, const Settings& settings);

/// `saccade eval --merge`: the same files from the results of all shards.
void eval_merge(const EvalArguments& arguments, const Settings& settings);

/// Adds the subcommand; when it is given, parsing sets `action` to what it does.
void add_eval_command(CLI::App& app, std::function<void()>& action);

}  // namespace saccade
