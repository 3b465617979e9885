#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "eval/result_file.hpp"

namespace saccade {

/// The results of shards that belong together.
struct ShardedResults {
  EvalPlan plan;  ///< of the whole; EvalPlan::missing says what is lacking
  bool complete = false;
  std::vector<ResultFile> files;
};

/// Reads the results of all shards. Throws Error (usage) if the folders hold different plans or content, if a
/// shard is given twice, or if one is missing or not complete; the message names all of these. With `partial`
/// the last two are no error: the results are then not complete.
[[nodiscard]] ShardedResults find_shards(const std::vector<std::filesystem::path>& folders, bool partial);

/// Writes the results of all shards into `folder` as those of one run, images in the order of their frames:
/// all of them or, if that fails, nothing. Needs the memory of a few images for each file. Returns what the
/// new file holds. Throws Error.
[[nodiscard]] ResultFile write_merged(const std::filesystem::path& folder, const ShardedResults& results);

/// What a folder holds of an evaluation.
struct ShardStatus {
  std::filesystem::path folder;
  std::string problem;        ///< why there are no results; empty = there are
  int shard = 0, shards = 0;  ///< 0 with a problem
  std::int64_t done = 0, of = 0;
  bool complete = false;
  std::string running;  ///< the process that is at work on it; empty = none
};

/// In the order of `folders`.
[[nodiscard]] std::vector<ShardStatus> shard_status(const std::vector<std::filesystem::path>& folders);

/// The shards that none of the folders holds, as "2, 5-7"; empty if all are there or nothing is known.
[[nodiscard]] std::string missing_shards(const std::vector<ShardStatus>& status);

/// Numbers in ascending order as "2, 5-7".
[[nodiscard]] std::string ranges_text(const std::vector<int>& numbers);

}  // namespace saccade
