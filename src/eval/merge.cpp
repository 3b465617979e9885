#include "eval/merge.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file_writer.hpp"
#include "core/folder_lock.hpp"
#include "eval/result_reader.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// Those of 1..shards that are not in `seen`.
template <typename Seen>
std::vector<int> others(int shards, const Seen& seen) {
  std::vector<int> numbers;
  for (int shard = 1; shard <= shards; ++shard)
    if (!seen.contains(shard)) numbers.push_back(shard);
  return numbers;
}

std::string shards_text(const std::vector<int>& numbers) {
  return fmt::format("shard{} {}", numbers.size() == 1 ? "" : "s", ranges_text(numbers));
}

// "of 8 shards, shards 2, 5-7 are missing and shard 3 is not complete"; empty if nothing is wrong.
std::string lack_text(int shards, const std::vector<int>& missing, const std::vector<int>& incomplete) {
  if (missing.empty() && incomplete.empty()) return "";
  std::string text = fmt::format("of {} shards, ", shards);
  if (!missing.empty()) text += shards_text(missing) + (missing.size() == 1 ? " is" : " are") + " missing";
  if (!missing.empty() && !incomplete.empty()) text += " and ";
  if (!incomplete.empty())
    text += shards_text(incomplete) + (incomplete.size() == 1 ? " is" : " are") + " not complete";
  return text;
}

// Shards may be of one evaluation: the same plan but for the number of the shard.
void check_same(const EvalPlan& whole, EvalPlan part, const fs::path& folder) {
  part.shard = whole.shard;
  if (const auto other = difference(whole, part))
    throw usage_error("the shards are of different evaluations: " + *other, folder.string(),
                      "merge shards of one evaluation only");
}

}  // namespace

std::string ranges_text(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (end - i > 1) text += (end - i > 2 ? "-" : ", ") + std::to_string(numbers[end - 1]);
    i = end;
  }
  return text;
}

ShardedResults find_shards(const std::vector<fs::path>& folders, bool partial) {
  if (folders.empty()) throw std::invalid_argument("find_shards: no folders");
  ShardedResults results;
  std::map<int, bool> seen;  // whether each shard is complete
  std::int64_t images = 0;
  for (const fs::path& folder : folders) {
    const ResultFile& file = results.files.emplace_back(scan_results(folder));
    check_same(results.files.front().plan, file.plan, folder);
    if (!seen.emplace(file.plan.shard, file.complete).second)
      throw usage_error(fmt::format("shard {}/{} is given twice", file.plan.shard, file.plan.shards),
                        folder.string(), "name each shard's folder once");
    images += file.images;
  }
  std::vector<int> incomplete;
  for (const auto& [shard, complete] : seen)
    if (!complete) incomplete.push_back(shard);
  results.plan = results.files.front().plan;
  const std::string lack = lack_text(results.plan.shards, others(results.plan.shards, seen), incomplete);
  if (!lack.empty() && !partial)
    throw usage_error(lack, folders.front().string(),
                      "name all folders; a shard's own command continues it; --partial merges what is there");
  results.plan.shard = results.plan.shards = 1;
  results.complete = lack.empty();
  if (!lack.empty())
    results.plan.missing = fmt::format("{}; {} of {} images", lack, images, results.plan.positions);
  return results;
}

ResultFile write_merged(const fs::path& folder, const ShardedResults& results) {
  ResultFile merged{folder / kResultFile, results.plan, 0, results.complete, {}, 0};
  ResultReader reader(results.files);
  FileWriter file(merged.path);
  const auto write = [&](const std::string& line) {
    file.write(line + "\n");
    merged.bytes += line.size() + 1;
  };
  write(plan_line(results.plan));
  FileRun run{merged.bytes, merged.bytes};
  for (; const auto image = reader.next(); ++merged.images) write(image_line(*image));
  run.end = merged.bytes;
  merged.runs = {run};
  if (results.complete) write(end_line());
  file.finish();
  return merged;
}

std::vector<ShardStatus> shard_status(const std::vector<fs::path>& folders) {
  std::vector<ShardStatus> all;
  for (const fs::path& folder : folders) {
    ShardStatus& status = all.emplace_back();
    status.folder = folder;
    try {
      status.running = lock_owner(folder);
      const ResultFile file = scan_results(folder);
      status.shard = file.plan.shard;
      status.shards = file.plan.shards;
      status.done = file.images;
      status.of = file.plan.positions_of_shard();
      status.complete = file.complete;
    } catch (const Error& error) {
      status.problem = error.what();
    }
  }
  return all;
}

std::string missing_shards(const std::vector<ShardStatus>& status) {
  std::map<int, bool> seen;
  int shards = 0;
  for (const ShardStatus& one : status) {
    if (one.shard > 0) seen[one.shard] = true;
    shards = std::max(shards, one.shards);
  }
  return ranges_text(others(shards, seen));
}

}  // namespace saccade
