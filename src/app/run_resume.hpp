#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/run_report.hpp"

namespace saccade {

/// How far an earlier run came.
struct ResumePoint {
  bool complete = false;
  std::int64_t positions = 0;  ///< selected frames that have a result or were rejected
  std::int64_t frames = 0;     ///< of these, with a result: lines of fixations.jsonl
  std::vector<std::pair<std::int64_t, std::string>> rejected;  ///< of the others, as its manifest lists them
};

/// Where the run of `report` goes on in `folder`; none if no run has begun there. The last `unsure` results
/// are given up, since their files may be missing if the program was killed; fixations.jsonl is cut
/// accordingly. Throws Error: (usage) the folder holds another run, and in what it differs; (unreadable) its
/// manifest.json or fixations.jsonl is damaged.
[[nodiscard]] std::optional<ResumePoint> find_resume_point(const std::filesystem::path& folder,
                                                           const RunReport& report, std::int64_t unsure);

}  // namespace saccade
