#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/eval.hpp"
#include "app/standard_output.hpp"
#include "core/error.hpp"
#include "eval/merge.hpp"

namespace saccade {
namespace {

std::string state_of(const ShardStatus& shard) {
  if (shard.complete) return "complete";
  return shard.running.empty() ? "stopped" : "in use by " + shard.running;
}

std::string to_text(const ShardStatus& shard) {
  const std::string folder = shard.folder.string();
  if (!shard.problem.empty()) return fmt::format("{}   {}\n", folder, shard.problem);
  return fmt::format("{}   shard {}/{}   {} of {} images   {}\n", folder, shard.shard, shard.shards,
                     shard.done, shard.of, state_of(shard));
}

nlohmann::ordered_json to_json(const ShardStatus& shard) {
  return {{"folder", shard.folder.string()},
          {"shard", shard.shard},
          {"shards", shard.shards},
          {"done", shard.done},
          {"of", shard.of},
          {"complete", shard.complete},
          {"running", shard.running},
          {"problem", shard.problem}};
}

}  // namespace

void eval_status(const EvalArguments& arguments, bool json) {
  const auto status = shard_status({arguments.status.begin(), arguments.status.end()});
  const std::string missing = missing_shards(status);
  const auto done = std::ranges::count_if(status, &ShardStatus::complete);
  int shards = 0;
  for (const ShardStatus& shard : status) shards = std::max(shards, shard.shards);
  const bool complete = shards > 0 && missing.empty() && done == static_cast<std::ptrdiff_t>(status.size());
  if (json) {
    auto list = nlohmann::ordered_json::array();
    for (const ShardStatus& shard : status) list.push_back(to_json(shard));
    print_json({{"complete", complete}, {"missing", missing}, {"shards", list}}, 2);
  } else {
    for (const ShardStatus& shard : status) print_text(to_text(shard));
  }
  if (!complete)
    throw Error(ExitStatus::unfinished,
                fmt::format("{} of {} shards complete{}", done, shards,
                            missing.empty() ? "" : "; missing: " + missing),
                "", "the command of a shard goes on from where it stopped");
}

}  // namespace saccade
