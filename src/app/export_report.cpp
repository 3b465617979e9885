#include "app/export_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace saccade {

nlohmann::ordered_json export_json(const ExportReport& report) {
  return {{"status", report.interrupted ? "interrupted" : "done"},
          {"out", report.out},
          {"format", report.format},
          {"frames", report.ledger.processed},
          {"dropped", report.ledger.dropped},
          {"rejected", report.ledger.rejected},
          {"incomplete", report.incomplete.count()},
          {"rounded_pixels", report.losses.rounded_pixels},
          {"largest_rounding_mm", report.losses.largest_rounding_mm},
          {"out_of_range_pixels", report.losses.out_of_range_pixels},
          {"wall_s", report.wall_s}};
}

std::string export_text(const ExportReport& report) {
  const Ledger& ledger = report.ledger;
  return fmt::format("{} frame{} in {:.2f} s ({:.1f}/s){}{}{}; see {}", ledger.processed,
                     ledger.processed == 1 ? "" : "s", report.wall_s,
                     static_cast<double>(ledger.processed) / std::max(report.wall_s, 1e-9),
                     report.source.live ? fmt::format(", {} dropped", ledger.dropped) : "",
                     ledger.rejected > 0 ? fmt::format(", {} rejected", ledger.rejected) : "",
                     report.interrupted ? ", interrupted" : "", report.out);
}

void report_losses(const ExportReport& report) {
  if (const auto count = report.rejected.count(); count > 0)
    spdlog::warn("{}: {} rejected, the first, {}", report.source.uri, counted(count, "frame"),
                 report.rejected.first());
  report_incomplete(report.source.uri, report.incomplete);
  report_depth_losses(report.losses, report.out);
}

void report_depth_losses(const DepthLosses& losses, const std::string& out) {
  if (losses.rounded_pixels > 0)
    spdlog::warn("{}: depth of {} was rounded to the stored unit, by at most {:.3g} mm", out,
                 counted(losses.rounded_pixels, "pixel"), losses.largest_rounding_mm);
  if (losses.out_of_range_pixels > 0)
    spdlog::warn("{}: {} too far for 16 bits of the stored unit, and so without a reading", out,
                 counted(losses.out_of_range_pixels, "pixel"));
}

}  // namespace saccade
