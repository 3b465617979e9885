#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/evaluator.hpp"
#include "eval/plan.hpp"

namespace saccade {

inline constexpr const char* kResultFile = "results.jsonl";

/// The content of a results.jsonl: a line with the plan, a line for each image, and a last line once all
/// images of the shard are there.
struct StoredResults {
  EvalPlan plan;
  std::vector<ImageResult> images;  ///< in the order of the lines
  bool complete = false;            ///< the last line is there
};

/// The lines of results.jsonl, without line feeds.
std::string plan_line(const EvalPlan& plan);
std::string image_line(const ImageResult& image);
std::string end_line();

/// Reads `folder`/results.jsonl. Ignores a last line that was cut while it was written.
/// Throws Error (unreadable) naming the file and line if it cannot be read.
[[nodiscard]] StoredResults read_results(const std::filesystem::path& folder);

/// The results that an interrupted evaluation of `plan` left in `folder`. Removes a cut last line from the
/// file, so that lines can be appended. If there is no file, writes a new one that holds only the plan.
/// Throws Error (usage), naming what differs, if the file belongs to another plan.
[[nodiscard]] StoredResults resume_results(const std::filesystem::path& folder, const EvalPlan& plan);

/// The results of all shards as those of one run, images in the order of their frames. Throws Error (usage)
/// if the folders hold different plans, if a shard is missing or given twice, or if one is not complete.
[[nodiscard]] StoredResults merge_results(const std::vector<std::filesystem::path>& folders);

/// Writes results.jsonl of a complete evaluation: all of it or, if that fails, nothing. Throws Error
/// (failed).
void write_results(const std::filesystem::path& folder, const StoredResults& results);

}  // namespace saccade
