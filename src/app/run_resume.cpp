#include "app/run_resume.hpp"

#include <algorithm>
#include <deque>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/frame.hpp"
#include "core/line_reader.hpp"
#include "output/json_text.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kLargestManifest = 1u << 30;
constexpr const char* kOther = "choose another --out, or leave out --resume to begin again";

Error damaged(const fs::path& path) {
  return unreadable("not of a run of this program", path.string(), "leave out --resume to begin again");
}

nlohmann::json read_manifest(const fs::path& path) {
  const auto bytes = read_file(path, kLargestManifest);
  nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
  if (!json.is_object() || !json.contains("settings")) throw damaged(path);
  return json;
}

// Whether the files of a run depend on the setting.
bool matters(const SettingSpec& spec) {
  return spec.scope != SettingScope::program && spec.key != "json" && spec.key != "stream";
}

void check_same(const nlohmann::json& earlier, const nlohmann::json& present, const std::string& what,
                const fs::path& folder) {
  if (earlier == present) return;
  throw usage_error(
      fmt::format("the folder has another run: its {} is {}, not {}", what, dump(earlier), dump(present)),
      folder.string(), kOther);
}

void check_same_run(const nlohmann::json& earlier, const nlohmann::json& present, const fs::path& folder) {
  for (const char* key : {"version", "formats", "shard"})
    check_same(earlier.value(key, nlohmann::json()), present.value(key, nlohmann::json()), key, folder);
  check_same(earlier.at("source").at("uri"), present.at("source").at("uri"), "source", folder);
  const nlohmann::json &before = earlier.at("settings"), &now = present.at("settings");
  for (const SettingSpec& spec : setting_specs())
    if (const std::string key(spec.key); matters(spec)) check_same(before.at(key), now.at(key), key, folder);
}

// Of a line of fixations.jsonl or a rejected frame. Other numbers, which somebody else must have written, are
// not converted: from some there is no way to an integer, and others would overflow.
std::int64_t frame_of(const nlohmann::json& json, const fs::path& path) {
  if (!json.is_object() || !json.contains("frame")) throw damaged(path);
  const nlohmann::json& frame = json["frame"];
  if (!frame.is_number_integer() || frame < 0 || frame > kLastFrameIndex) throw damaged(path);
  return frame.get<std::int64_t>();
}

struct Line {
  std::int64_t frame;
  std::uintmax_t end;  // in the file
};

// Counts the lines of fixations.jsonl but for the last `unsure`, which are cut off; returns the last one that
// is left.
std::optional<Line> keep_lines(const fs::path& path, std::int64_t unsure, std::int64_t& count) {
  std::error_code code;
  if (!fs::exists(path, code)) return std::nullopt;
  LineReader reader(path);
  std::optional<Line> kept;
  std::deque<Line> last;
  std::int64_t frame = -1;
  for (std::string_view line; reader.next(line);) {
    if (const std::int64_t before =
            std::exchange(frame, frame_of(nlohmann::json::parse(line, nullptr, false), path));
        frame <= before)
      throw damaged(path);
    last.push_back({frame, reader.position()});
    if (static_cast<std::int64_t>(last.size()) <= unsure) continue;
    kept = last.front();
    last.pop_front();
    ++count;
  }
  fs::resize_file(path, kept ? kept->end : 0);
  return kept;
}

void add_rejected(const nlohmann::json& manifest, const fs::path& path, std::int64_t last,
                  ResumePoint& point) {
  for (const nlohmann::json& one : manifest.value("rejected", nlohmann::json::array()))
    if (const std::int64_t frame = frame_of(one, path); frame <= last)
      point.rejected.emplace_back(frame, one.at("reason"));
}

}  // namespace

std::optional<ResumePoint> find_resume_point(const fs::path& folder, const RunReport& report,
                                             std::int64_t unsure) {
  const fs::path path = folder / "manifest.json", lines = folder / "fixations.jsonl";
  std::error_code code;
  if (!fs::exists(path, code)) return std::nullopt;
  const nlohmann::json manifest = read_manifest(path);
  ResumePoint point;
  try {
    check_same_run(manifest, nlohmann::json(manifest_json(report)), folder);
    point.complete = manifest.at("status") == "done";
    if (point.complete) return point;
    if (fs::is_symlink(lines, code)) throw failed("it is a symbolic link", lines.string(), "delete it");
    const auto kept = keep_lines(lines, unsure, point.frames);
    if (!kept) return point;
    point.positions = (kept->frame - report.settings.start) / report.settings.every + 1;
    if (point.positions < point.frames) throw damaged(lines);
    add_rejected(manifest, path, kept->frame, point);
  } catch (const nlohmann::json::exception&) {
    throw damaged(path);
  }
  return point;
}

void check_can_resume(const RunReport& report, bool tracks) {
  const auto refuse = [](const std::string& reason, const std::string& hint) {
    return usage_error(reason, "--resume", hint);
  };
  if (report.source.live) throw refuse("a live source does not give its frames again", "leave it out");
  if (tracks)
    throw refuse("attention over time needs all frames in order",
                 "leave it out, or take frames one by one with --tracking off");
  for (const char* file : {"depth", "colour"})
    if (report.settings.dump.contains(file))
      throw refuse(fmt::format("a data set (--dump {}) cannot be continued", file), "leave it out");
}

std::optional<FrameSettings> frames_left(const RunReport& report, const std::optional<ResumePoint>& earlier) {
  FrameSettings frames = report.settings;
  if (!earlier) return frames;
  frames.start += earlier->positions * frames.every;
  if (frames.frames > 0) frames.frames -= earlier->positions;
  const bool are_limited = report.settings.frames > 0;
  const auto& count = report.source.frame_count;
  if ((are_limited && frames.frames <= 0) || (count && frames.start >= *count)) return std::nullopt;
  return frames;
}

}  // namespace saccade
