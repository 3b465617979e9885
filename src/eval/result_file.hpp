#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "eval/evaluator.hpp"
#include "eval/plan.hpp"

namespace saccade {

/// A line with the plan, a line for each image, and a last line once all images of the shard are there. A
/// file may be larger than the memory: it is read line by line.
inline constexpr const char* kResultFile = "results.jsonl";

/// The lines of results.jsonl, without line feeds.
std::string plan_line(const EvalPlan& plan);
std::string image_line(const ImageResult& image);
std::string end_line();

/// The image of a line that scan_results() has seen.
[[nodiscard]] ImageResult parse_image(std::string_view line, const EvalPlan& plan);

/// Lines of a file, as bytes from `begin` to `end`, whose frames ascend.
struct FileRun {
  std::uintmax_t begin = 0, end = 0;
};

/// What a results.jsonl holds.
struct ResultFile {
  std::filesystem::path path;
  EvalPlan plan;
  std::int64_t images = 0;
  bool complete = false;      ///< the last line is there
  std::vector<FileRun> runs;  ///< of all images; one, unless an evaluation went on from partial results
  std::uintmax_t bytes = 0;   ///< without a last line that was cut while it was written
};

/// Reads `folder`/results.jsonl and gives each image to `see`, which may throw std::exception if it is wrong.
/// Ignores a last line that was cut. Throws Error (unreadable) naming the file and line if it cannot be read.
[[nodiscard]] ResultFile scan_results(const std::filesystem::path& folder,
                                      const std::function<void(const ImageResult&)>& see = {});

/// What an interrupted evaluation left.
struct ResumedResults {
  std::int64_t images = 0;
  bool complete = false;
  std::vector<bool> known;  ///< the positions of the plan that have a result
};

/// The results that an interrupted evaluation of `plan` left in `folder`. Removes a cut last line from the
/// file, so that lines can be appended. If there is no file, writes a new one that holds only the plan.
/// Throws Error (usage), naming what differs, if the file belongs to another plan; (unreadable) if it cannot
/// be read, or holds a frame twice or one that is not of the plan.
[[nodiscard]] ResumedResults resume_results(const std::filesystem::path& folder, const EvalPlan& plan);

}  // namespace saccade
