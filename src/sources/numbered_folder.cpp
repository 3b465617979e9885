#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "sources/numbered_frames.hpp"
#include "sources/poses_file.hpp"
#include "sources/times_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

// The number in "NNNN_depth.png"; std::nullopt for another name.
std::optional<std::int64_t> frame_number(const std::string& name) {
  constexpr std::string_view kEnding = "_depth.png";
  if (!lower_case(name).ends_with(kEnding)) return std::nullopt;
  std::int64_t number = 0;
  const char* end = name.data() + name.size() - kEnding.size();
  const auto [stop, code] = std::from_chars(name.data(), end, number);
  if (code != std::errc{} || stop != end || number < 0) return std::nullopt;
  return number;
}

FolderListing list_numbered(const fs::path& folder) {
  const FolderNames names(folder);
  std::map<std::int64_t, FolderEntry> found;
  for (const std::string& name : names.all()) {
    const auto number = frame_number(name);
    if (!number) continue;
    const std::string stem = name.substr(0, name.find('_'));
    FolderEntry entry;
    entry.name = stem;
    entry.depth = folder / name;
    entry.colour = names.first_of({stem + "_rgb.png", stem + "_rgb.jpg", stem + "_rgb.jpeg"});
    entry.label = names.first_of({stem + "_label.png", stem + "_labels.png"});
    entry.classes = names.first_of({stem + "_class.png"});
    if (!found.emplace(*number, entry).second)
      throw unreadable("two depth images have the same number", entry.depth.string(), "rename or delete one");
  }
  const auto poses = read_poses(folder);
  FolderListing listing = list_by_number(std::move(found), read_times(folder / "times.txt"));
  listing.sequence = listing.sequence || !poses.empty();
  for (std::size_t i = 0; i < std::min(poses.size(), listing.entries.size()); ++i)
    listing.entries[i].camera_to_world = poses[i];
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
    .help = "NNNN_depth.png (16 bits), with NNNN_rgb.png or .jpg and NNNN_label.png where there are any",
    .recognised_by = "NNNN_depth.png",
    .recognises = has_numbered_depth,
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path, kNumberedKind.name, list_numbered(input.path), options.input);
        },
};

}  // namespace saccade
