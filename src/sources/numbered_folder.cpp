#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "sources/folder_source.hpp"
#include "sources/poses_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// The number in "NNNN_depth.png"; std::nullopt for another name.
std::optional<std::int64_t> frame_number(const std::string& name) {
  constexpr std::string_view kEnding = "_depth.png";
  if (!name.ends_with(kEnding)) return std::nullopt;
  std::int64_t number = 0;
  const char* end = name.data() + name.size() - kEnding.size();
  const auto [stop, code] = std::from_chars(name.data(), end, number);
  if (code != std::errc{} || stop != end || number < 0) return std::nullopt;
  return number;
}

fs::path first_existing(const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (fs::exists(folder / name)) return folder / name;
  return {};
}

// "4 frames are missing in the numbering: 3, 7..9"; std::nullopt if none is.
std::optional<std::string> describe_gaps(const std::map<std::int64_t, FolderEntry>& found) {
  std::vector<std::string> gaps;
  std::int64_t missing = 0, expected = found.begin()->first;
  for (const auto& [number, entry] : found) {
    if (number > expected) {
      missing += number - expected;
      gaps.push_back(number - expected == 1 ? fmt::format("{}", expected)
                                            : fmt::format("{}..{}", expected, number - 1));
    }
    expected = number + 1;
  }
  if (gaps.empty()) return std::nullopt;
  constexpr std::size_t kShown = 8;
  const std::size_t shown = std::min(kShown, gaps.size());
  std::vector<std::string> first(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(shown));
  return fmt::format("{} frame{} missing in the numbering: {}{}", missing, missing == 1 ? " is" : "s are",
                     fmt::join(first, ", "), shown < gaps.size() ? ", ..." : "");
}

FolderListing list_numbered(const fs::path& folder) {
  std::map<std::int64_t, FolderEntry> found;
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().filename().string();
    const auto number = frame_number(name);
    if (!number) continue;
    const std::string stem = name.substr(0, name.find('_'));
    FolderEntry entry;
    entry.name = stem;
    entry.depth = file.path();
    entry.colour = first_existing(folder, {stem + "_rgb.png", stem + "_rgb.jpg", stem + "_rgb.jpeg"});
    entry.label = first_existing(folder, {stem + "_label.png"});
    entry.classes = first_existing(folder, {stem + "_class.png"});
    if (!found.emplace(*number, entry).second)
      throw unreadable("two depth images have the same number", file.path().string(), "rename or delete one");
  }
  const std::vector<cv::Affine3d> poses = read_poses(folder);
  FolderListing listing;
  listing.sequence = !poses.empty();
  for (auto& [number, entry] : found) {
    if (listing.entries.size() < poses.size()) entry.camera_to_world = poses[listing.entries.size()];
    entry.timestamp_us =
        std::llround(static_cast<double>(number - found.begin()->first) * 1e6 / listing.rate_hz);
    listing.entries.push_back(entry);
  }
  if (const auto gaps = describe_gaps(found)) listing.notes.push_back(*gaps);
  return listing;
}

bool has_numbered_depth(const SourceInput& input) {
  if (input.type != SourceInput::Type::folder) return false;
  std::error_code code;
  for (fs::directory_iterator file(input.path, code), end; !code && file != end; file.increment(code))
    if (frame_number(file->path().filename().string())) return true;
  return false;
}

}  // namespace

extern const SourceKind kNumberedKind = {
    .name = "folder",
    .written = "FOLDER",
    .help = "NNNN_depth.png (16 bits, mm), with NNNN_rgb.png or .jpg and NNNN_label.png where there are any",
    .recognised_by = "NNNN_depth.png",
    .recognises = has_numbered_depth,
    .open =
        [](const SourceInput& input, const SensorSettings&) {
          return open_folder(input, kNumberedKind.name, list_numbered(input.path));
        },
};

}  // namespace saccade
