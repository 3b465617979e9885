#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "sources/folder_source.hpp"
#include "sources/poses_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPoses = "groundtruth.txt";
constexpr const char* kTumHint = "each line names a time in seconds and a file";

struct TimedFile {
  double time_s = 0;
  std::string stamp;
  fs::path path;
};

bool has_control_characters(const std::string& name) {
  return std::ranges::any_of(name, [](unsigned char c) { return std::iscntrl(c) != 0; });
}

// A list may come from somebody else: it must not lead to other files of this machine.
bool is_inside(const fs::path& name) {
  return name.is_relative() && std::ranges::find(name, fs::path("..")) == name.end();
}

// The file nearest in time among `files`, which are in the order of their times; end() if there are none.
std::vector<TimedFile>::const_iterator nearest_to(const std::vector<TimedFile>& files, double time_s) {
  const auto after = std::ranges::lower_bound(files, time_s, {}, &TimedFile::time_s);
  if (after == files.begin()) return after;
  const double before_s = std::prev(after)->time_s;
  if (after != files.end() && after->time_s - time_s < time_s - before_s) return after;
  return std::ranges::lower_bound(files, before_s, {}, &TimedFile::time_s);  // the first of equal times
}

// A TUM list: "timestamp filename" lines, '#' starts a comment.
std::vector<TimedFile> read_tum_list(const fs::path& list) {
  const auto bytes = read_file(list, 256u << 20);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::vector<TimedFile> files;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    std::istringstream fields(line);
    std::string stamp, name;
    fields >> stamp >> name;
    double time_s = 0;
    const auto [end, code] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), time_s);
    if (code != std::errc{} || end != stamp.data() + stamp.size() || !std::isfinite(time_s) || name.empty() ||
        has_control_characters(name))
      throw unreadable("not a 'timestamp filename' line", fmt::format("{}:{}", list.string(), number),
                       kTumHint);
    if (!is_inside(name))
      throw unreadable("a file outside of the folder", fmt::format("{}:{}", list.string(), number),
                       "each line names a file below the folder of the list");
    files.push_back({time_s, stamp, list.parent_path() / name});
  }
  std::stable_sort(files.begin(), files.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return files;
}

FolderListing list_tum(const fs::path& folder) {
  constexpr double kUnitsPerMetre = 5000, kSameMoment_s = 0.02, kLatest_us = 9e18;
  FolderListing listing;
  listing.mm_per_unit = 1000 / kUnitsPerMetre;
  const auto depth = read_tum_list(folder / "depth.txt");
  if (depth.empty()) throw unreadable("no frames in the list", (folder / "depth.txt").string(), kTumHint);
  std::vector<TimedFile> colour;
  std::error_code code;
  if (fs::exists(folder / "rgb.txt", code)) colour = read_tum_list(folder / "rgb.txt");
  std::optional<TimedPoses> poses;
  if (fs::exists(folder / kPoses, code)) poses.emplace(folder / kPoses);
  std::size_t without = 0, without_pose = 0;
  for (const TimedFile& file : depth) {
    const double time_us = std::min((file.time_s - depth.front().time_s) * 1e6, kLatest_us);
    FolderEntry entry{file.stamp, std::llround(time_us), file.path, {}, {}};
    const auto nearest = nearest_to(colour, file.time_s);
    if (nearest != colour.end() && std::abs(nearest->time_s - file.time_s) <= kSameMoment_s)
      entry.colour = nearest->path;
    else
      ++without;
    if (poses) entry.camera_to_world = poses->at(file.time_s);
    if (!entry.camera_to_world) ++without_pose;
    listing.entries.push_back(entry);
  }
  listing.sequence = true;
  const double span_s = depth.back().time_s - depth.front().time_s;
  if (span_s > 0) listing.rate_hz = static_cast<double>(depth.size() - 1) / span_s;
  if (!colour.empty() && without > 0)
    listing.notes.push_back(
        fmt::format("{} without a colour image within 20 ms", counted(without, "depth frame")));
  if (poses && without_pose > 0)
    listing.notes.push_back(
        fmt::format("{} without a pose in {}", counted(without_pose, "depth frame"), kPoses));
  return listing;
}

bool has_depth_list(const SourceInput& input) {
  std::error_code code;
  return input.type == SourceInput::Type::folder && fs::exists(input.path / "depth.txt", code);
}

}  // namespace

extern const SourceKind kTumKind = {
    .name = "tum",
    .written = "FOLDER",
    .help = "a sequence of TUM RGB-D: depth.txt, rgb.txt and the images that they list",
    .recognised_by = "depth.txt",
    .recognises = has_depth_list,
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path, kTumKind.name, list_tum(input.path), options.input);
        },
};

}  // namespace saccade
