#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/frame_source.hpp"
#include "pipeline/ledger.hpp"
#include "pipeline/stage_statistics.hpp"
#include "settings/settings.hpp"

namespace saccade {

/// What a run was and what became of it; manifest.json and the summary of --json.
struct RunReport {
  std::string status = "running";  ///< running, done, interrupted or failed
  std::string error;               ///< the line that was printed, if it failed
  std::vector<std::string> command_line;
  SourceInfo source;
  Settings settings;
  int workers = 0;  ///< as resolved
  Ledger ledger;
  std::vector<std::pair<std::int64_t, std::string>> rejected;  ///< source index and reason; the first 10000
  StageStatistics stages;
  DurationHistogram latency;          ///< from the capture of a frame to its result
  std::optional<SourceState> device;  ///< how a live source was doing at the end
  double wall_s = 0;
  std::string out;
};

/// The whole report: manifest.json.
nlohmann::ordered_json manifest_json(const RunReport& report);

/// How a live source's device did, in either.
nlohmann::ordered_json device_json(const SourceState& device);

/// Its short form: what --json prints.
nlohmann::ordered_json summary_json(const RunReport& report);

}  // namespace saccade
