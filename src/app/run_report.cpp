#include "app/run_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

#include "app/progress.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "output/fixations_json.hpp"
#include "settings/settings_format.hpp"

namespace saccade {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value) { return std::round(value * 1000) / 1000; }

Json ledger_json(const Ledger& ledger) {
  return {{"captured", ledger.captured},
          {"processed", ledger.processed},
          {"dropped", ledger.dropped},
          {"rejected", ledger.rejected}};
}

Json intrinsics_json(const Intrinsics& camera) {
  return {{"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"from", to_string(camera.origin)}};
}

// With the keys of a TOML file, so that the run can be repeated.
Json settings_json(const Settings& settings) {
  Json json = Json::object();
  for (const SettingSpec& spec : setting_specs()) {
    const std::string text = spec.print(settings);
    Json value = Json::parse(text, nullptr, false);  // numbers, true and false are no strings
    json[std::string(spec.key)] = value.is_number() || value.is_boolean() ? value : Json(text);
  }
  return json;
}

Json times_json(const DurationHistogram& times) {
  return {{"mean", rounded(times.mean_ms())},
          {"p50", rounded(times.percentile_ms(0.50))},
          {"p95", rounded(times.percentile_ms(0.95))},
          {"p99", rounded(times.percentile_ms(0.99))},
          {"max", rounded(times.max_ms())}};
}

Json stages_json(const StageStatistics& stages) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kStageNames.size(); ++i)
    json[std::string(kStageNames[i])] = times_json(stages[static_cast<Stage>(i)]);
  return json;
}

Json source_json(const SourceInfo& source) {
  Json json = {{"uri", source.uri},          {"kind", source.kind},
               {"width", source.size.width}, {"height", source.size.height},
               {"frames", nullptr},          {"rate_hz", rounded(source.rate_hz)},
               {"notes", source.notes}};
  if (source.frame_count) json["frames"] = *source.frame_count;
  return json;
}

// Of this process.
double frames_per_s(const RunReport& report) {
  return static_cast<double>(report.ledger.processed - report.resumed) / std::max(report.wall_s, 1e-9);
}

Json tracks_json(const TrackLog& log) {
  Json tracks = Json::array();
  for (const auto& [id, track] : log.tracks())
    tracks.push_back({{"id", id},
                      {"first_frame", track.first_frame},
                      {"last_frame", track.last_frame},
                      {"frames", track.frames},
                      {"looks", track.looks},
                      {"world_mm", {track.world_mm.x, track.world_mm.y, track.world_mm.z}}});
  return {{"cuts", log.cuts()}, {"unlisted", log.unlisted()}, {"tracks", tracks}};
}

}  // namespace

Json device_json(const SourceState& device) {
  return {{"state", device.connection == SourceState::Connection::streaming ? "streaming"
                    : device.connection == SourceState::Connection::lost    ? "lost"
                                                                            : "waiting"},
          {"text", device.text},
          {"losses", device.losses},
          {"away_s", rounded(device.away_s)},
          {"without_colour", device.colourless},
          {"notes", device.notes}};
}

Json summary_json(const RunReport& report) {
  const double rate = frames_per_s(report);
  Json json = {{"program", "saccade"}, {"version", kVersion}, {"status", report.status}};
  if (!report.error.empty()) json["error"] = report.error;
  json["out"] = report.out;
  json["ledger"] = ledger_json(report.ledger);
  if (report.resumed > 0) json["resumed"] = report.resumed;
  json["wall_s"] = rounded(report.wall_s);
  json["frames_per_s"] = rounded(rate);
  json["stages_ms"] = stages_json(report.stages);
  json["latency_ms"] = times_json(report.latency);
  json["dropped_by"] = {{"newer_frame", report.ledger.replaced}, {"end", report.ledger.stopped()}};
  if (report.stream)
    json["stream"] = {{"to", report.settings.stream},
                      {"sent", report.stream->sent},
                      {"dropped", report.stream->dropped},
                      {"closed", report.stream->closed}};
  if (report.device) json["device"] = device_json(*report.device);
  return json;
}

Json manifest_json(const RunReport& report) {
  Json json = summary_json(report);
  json["formats"] = {
      {"manifest", kManifestFormat}, {"fixations", kFixationsFormat}, {"settings", kSettingsFormat}};
  json["command_line"] = report.command_line;
  json["source"] = source_json(report.source);
  json["intrinsics"] = intrinsics_json(report.settings.intrinsics.value_or(report.source.intrinsics));
  json["settings"] = settings_json(report.settings);
  if (!report.shard.empty()) json["shard"] = report.shard;
  json["workers"] = report.workers;
  if (!report.tracks.empty()) json["tracking"] = tracks_json(report.tracks);
  Json rejected = Json::array();
  for (const auto& [index, reason] : report.rejected)
    rejected.push_back({{"frame", index}, {"reason", reason}});
  json["rejected"] = rejected;
  if (report.incomplete.count() > 0)
    json["incomplete"] = {{"frames", report.incomplete.count()}, {"first", report.incomplete.first()}};
  return json;
}

std::string summary_text(const RunReport& report) {
  const Ledger& ledger = report.ledger;
  return fmt::format("{} in {:.2f} s ({:.1f}/s){}{}{}{}; see {}", counted(ledger.processed, "frame"),
                     report.wall_s, frames_per_s(report),
                     report.source.live ? ", " + live_text(ledger, report.latency) : "",
                     ledger.rejected > 0 ? fmt::format(", {} rejected", ledger.rejected) : "",
                     report.stream && report.stream->dropped > 0
                         ? fmt::format(", {} lines of the stream dropped", report.stream->dropped)
                         : "",
                     report.status == "interrupted" ? ", interrupted" : "", report.out);
}

void report_rejected(const RunReport& report) {
  report_incomplete(report.source.uri, report.incomplete);
  if (report.rejected.empty()) return;
  const auto& [index, reason] = report.rejected.front();
  spdlog::warn("{}: {} rejected (see manifest.json), the first, frame {}: {}", report.source.uri,
               counted(report.ledger.rejected, "frame"), index, reason);
}

}  // namespace saccade
