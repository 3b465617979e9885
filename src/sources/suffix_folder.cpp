// Folders in which the end of a name says what an image is: 7-Scenes, YCB-Video.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "sources/folder_files.hpp"
#include "sources/numbered_frames.hpp"
#include "sources/poses_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

struct SuffixLayout {
  std::string_view depth, colour_png, colour_jpg, label, pose;  // ends of names; empty = none
  double mm_per_unit = 1;
  Intrinsics camera{};
};

constexpr std::array<SuffixLayout, 2> kLayouts = {{
    {".depth.png",
     ".color.png",
     ".color.jpg",
     "",
     ".pose.txt",
     1,
     {585, 585, 320, 240, IntrinsicsOrigin::file}},  // 7-Scenes, by its description
    {"-depth.png",
     "-color.png",
     "-color.jpg",
     "-label.png",
     "",
     0.1,
     {1066.778, 1067.487, 312.9869, 241.3109, IntrinsicsOrigin::file}},  // YCB-Video, its first camera
}};

// What stands before the ending that says depth; std::nullopt for another name.
std::optional<std::string> stem_of(const std::string& name, const SuffixLayout& layout) {
  if (!lower_case(name).ends_with(layout.depth)) return std::nullopt;
  std::string stem = name.substr(0, name.size() - layout.depth.size());
  return first_number(stem) ? std::optional(stem) : std::nullopt;
}

// nullptr if a name is of no layout.
const SuffixLayout* layout_of(const std::string& name) {
  const auto found = std::ranges::find_if(
      kLayouts, [&](const SuffixLayout& layout) { return stem_of(name, layout).has_value(); });
  return found == kLayouts.end() ? nullptr : &*found;
}

const SuffixLayout* layout_of(const fs::path& folder) {
  std::error_code code;
  for (fs::directory_iterator file(folder, code), end; !code && file != end; file.increment(code))
    if (const SuffixLayout* layout = layout_of(file->path().filename().string())) return layout;
  return nullptr;
}

FolderListing list_suffixed(const fs::path& folder) {
  const SuffixLayout& layout = *layout_of(folder);
  const FolderNames names(folder);
  std::map<std::int64_t, FolderEntry> found;
  FramePoses poses;
  for (const std::string& name : names.all()) {
    const auto stem = stem_of(name, layout);
    if (!stem) continue;
    const auto with = [&](std::string_view ending) {
      return ending.empty() ? fs::path() : names.first_of({*stem + std::string(ending)});
    };
    FolderEntry entry;
    entry.name = *stem;
    entry.depth = folder / name;
    entry.colour = with(layout.colour_png);
    if (entry.colour.empty()) entry.colour = with(layout.colour_jpg);
    entry.label = with(layout.label);
    entry.camera_to_world = poses.read(with(layout.pose));
    if (!found.emplace(last_number(*stem).value_or(0), entry).second)
      throw unreadable("two depth images have the same number", entry.depth.string(), "rename or delete one");
  }
  FolderListing listing = list_by_number(std::move(found));
  listing.mm_per_unit = layout.mm_per_unit;
  listing.camera = layout.camera;
  listing.sequence = poses.any();
  poses.add_note(listing.notes);
  listing.notes.emplace_back("the camera is that of the data set's description; meta.json can name another");
  return listing;
}

}  // namespace

extern const SourceKind kSuffixKind = {
    .name = "suffix",
    .written = "FOLDER",
    .help =
        "7-Scenes (NAME.depth.png with .color.png, .pose.txt) and YCB-Video (NNN-depth.png with -color.png)",
    .recognised_by = "NAME.depth.png or NNN-depth.png",
    .recognises =
        [](const SourceInput& input) {
          return input.type == SourceInput::Type::folder && layout_of(input.path) != nullptr;
        },
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path, kSuffixKind.name, list_suffixed(input.path), options.input);
        },
};

}  // namespace saccade
