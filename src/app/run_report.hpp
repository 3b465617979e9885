#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/frame_problems.hpp"
#include "core/frame_source.hpp"
#include "output/line_stream.hpp"
#include "pipeline/ledger.hpp"
#include "pipeline/stage_statistics.hpp"
#include "settings/settings.hpp"
#include "tracking/track_log.hpp"

namespace saccade {

/// Version of the format of manifest.json (README.md, Versions).
inline constexpr int kManifestFormat = 1;

/// What a run did, for manifest.json and the summaries.
struct RunReport {
  std::string status = "running";  ///< running, done, interrupted or failed
  std::string error;               ///< the line that was printed, if it failed
  std::vector<std::string> command_line;
  SourceInfo source;
  Settings settings;
  std::string shard;         ///< "3/8"; empty = all frames
  std::int64_t resumed = 0;  ///< frames that an earlier run had computed; the ledger counts them too
  int workers = 0;           ///< worker_count(settings)
  Ledger ledger;
  std::vector<std::pair<std::int64_t, std::string>> rejected;  ///< source index and reason; the first 10000
  FrameProblems incomplete;  ///< frames without a colour image or labels that could not be read
  StageStatistics stages;
  DurationHistogram latency;               ///< from the capture of a frame to its result
  TrackLog tracks;                         ///< of attention over time; empty = frames were taken one by one
  std::optional<LineStreamCounts> stream;  ///< of --stream; none = it was not used
  std::optional<SourceState> device;       ///< state of a live source at the end
  double wall_s = 0;
  std::string out;
};

/// The whole report: manifest.json.
nlohmann::ordered_json manifest_json(const RunReport& report);

/// Its part about a live source.
nlohmann::ordered_json device_json(const SourceState& device);

/// The short form of the report that --json prints.
nlohmann::ordered_json summary_json(const RunReport& report);

/// One line, e.g. "90 frames in 2.41 s (37.3/s); see out/table".
std::string summary_text(const RunReport& report);

/// Warns of rejected and incomplete frames, if there are any.
void report_rejected(const RunReport& report);

}  // namespace saccade
