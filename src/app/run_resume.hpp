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

/// Throws Error (usage) if the run of `report` cannot be continued: its source is live, it `tracks` objects,
/// or it writes a data set.
void check_can_resume(const RunReport& report, bool tracks);

/// The frames that the run of `report` selects, without those that `earlier` has; none = nothing is left.
[[nodiscard]] std::optional<FrameSettings> frames_left(const RunReport& report,
                                                       const std::optional<ResumePoint>& earlier);

}  // namespace saccade
