#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "app/frame_problems.hpp"
#include "core/depth_units.hpp"
#include "core/frame_source.hpp"
#include "pipeline/ledger.hpp"

namespace saccade {

/// What `saccade export` did.
struct ExportReport {
  SourceInfo source;
  std::string out, format;
  bool interrupted = false;
  Ledger ledger;
  FrameProblems rejected, incomplete;
  DepthLosses losses;
  double wall_s = 0;
};

/// What --json prints.
nlohmann::ordered_json export_json(const ExportReport& report);

/// One line, e.g. "90 frames in 1.12 s (80.4/s); see out/frames".
std::string export_text(const ExportReport& report);

/// Warns of rejected and incomplete frames, and of depth that the format cannot hold exactly.
void report_losses(const ExportReport& report);

/// The same of depth alone, stored in `out`.
void report_depth_losses(const DepthLosses& losses, const std::string& out);

}  // namespace saccade
