#include "app/record_report.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "app/run_report.hpp"
#include "core/file.hpp"
#include "core/text.hpp"

namespace saccade {

nlohmann::ordered_json record_json(const RecordReport& report) {
  nlohmann::ordered_json json = {{"status", report.interrupted ? "interrupted" : "done"},
                                 {"file", report.file},
                                 {"frames", report.counts.frames},
                                 {"dropped", report.counts.dropped},
                                 {"rejected", report.rejected},
                                 {"incomplete", report.incomplete.count()},
                                 {"rounded", report.counts.rounded},
                                 {"most_unsynced", report.counts.most_unsynced},
                                 {"bytes", report.bytes},
                                 {"wall_s", report.wall_s}};
  if (report.device) json["device"] = device_json(*report.device);
  return json;
}

std::string record_text(const RecordReport& report) {
  const OniWriterCounts& counts = report.counts;
  const std::string slow_disk =
      counts.most_unsynced > 1
          ? fmt::format(", slow disk: up to {} frames at a time were unsynced", counts.most_unsynced)
          : "";
  return fmt::format("{} in {:.2f} s, {}, {} dropped{}{}{}; see {}", counted(counts.frames, "frame"),
                     report.wall_s, megabytes(static_cast<double>(report.bytes)), counts.dropped,
                     report.rejected > 0 ? fmt::format(", {} rejected", report.rejected) : "", slow_disk,
                     report.interrupted ? ", interrupted" : "", report.file);
}

void report_losses(const RecordReport& report) {
  if (report.rejected > 0)
    spdlog::warn("{}: {} rejected, the first, {}", report.source, counted(report.rejected, "frame"),
                 report.first_rejected);
  report_incomplete(report.source, report.incomplete);
  if (report.counts.rounded > 0)
    spdlog::warn("{}: depth of {} was rounded to the unit of the file, by at most {:.3g} mm", report.file,
                 counted(report.counts.rounded, "frame"), report.counts.largest_rounding_mm);
  if (report.counts.out_of_range_pixels > 0)
    spdlog::warn("{}: {} too far for the unit of the file, and so without a reading", report.file,
                 counted(report.counts.out_of_range_pixels, "pixel"));
}

}  // namespace saccade
