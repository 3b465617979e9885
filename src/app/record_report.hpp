#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "app/frame_problems.hpp"
#include "core/frame_source.hpp"
#include "oni/writer.hpp"

namespace saccade {

/// What `saccade record` did.
struct RecordReport {
  std::string source, file;
  bool interrupted = false;
  std::int64_t rejected = 0;   ///< frames of the source that could not be used
  std::string first_rejected;  ///< "frame 7: why"
  FrameProblems incomplete;    ///< frames without colour that the source should have had
  OniWriterCounts counts;
  std::optional<SourceState> device;  ///< state of a live source at the end
  std::uint64_t bytes = 0;            ///< size of the file
  double wall_s = 0;
};

/// What --json prints.
nlohmann::ordered_json record_json(const RecordReport& report);

/// One line, e.g. "90 frames in 3.02 s, 21 MB, 0 dropped; see a.oni".
std::string record_text(const RecordReport& report);

/// Warns of rejected frames, and of depth that the file cannot hold exactly.
void report_losses(const RecordReport& report);

}  // namespace saccade
