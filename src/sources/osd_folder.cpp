#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "sources/folder_files.hpp"
#include "sources/folder_source.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::array<const char*, 3> kDepthFolders = {"depth", "disparity", "point_cloud"};

fs::path find(const FilesByStem& files, const std::string& stem) {
  const auto file = files.find(stem);
  return file == files.end() ? fs::path() : file->second;
}

bool has_osd_folders(const SourceInput& input) {
  const auto holds = [&](const char* name) { return fs::is_directory(input.path / name); };
  return input.type == SourceInput::Type::folder && std::ranges::any_of(kDepthFolders, holds) &&
         (holds("image_color") || holds("annotation"));
}

// The frames in the natural order of their names (learn2 before learn10): for each name the file of the first
// depth folder that has it, with the files of the same name in image_color/ and annotation/.
FolderListing list_osd(const fs::path& folder) {
  const auto colour = files_of(folder / "image_color", kColourEndings);
  const auto labels = files_of(folder / "annotation", {".png"});
  FolderListing listing;
  listing.colours_are_labels = true;
  FilesByStem depth;
  for (const char* name : kDepthFolders) {
    const bool clouds = std::string(name) == "point_cloud";
    for (const auto& [stem, path] : files_of(folder / name, {clouds ? ".pcd" : ".png"})) {
      if (clouds && listing.cloud.empty()) listing.cloud = path;
      depth.emplace(stem, path);
    }
  }
  if (depth.empty())
    throw unreadable("no frames in the folder", folder.string(),
                     "expected 16-bit PNG in depth/ or disparity/, or .pcd in point_cloud/");
  for (const auto& [stem, path] : depth) {
    const auto number = static_cast<double>(listing.entries.size());
    listing.entries.push_back(
        {stem, std::llround(number * 1e6 / listing.rate_hz), path, find(colour, stem), find(labels, stem)});
  }
  const auto without = std::count_if(listing.entries.begin(), listing.entries.end(),
                                     [](const FolderEntry& entry) { return entry.label.empty(); });
  if (without > 0)
    listing.notes.push_back(fmt::format("{} of {} without a file of that name in annotation/", without,
                                        counted(listing.entries.size(), "frame")));
  return listing;
}

}  // namespace

extern const SourceKind kOsdKind = {
    .name = "osd",
    .written = "FOLDER",
    .help =
        "Object Segmentation Database: depth/, disparity/ or point_cloud/, with image_color/, annotation/",
    .recognised_by = "image_color/ or annotation/ beside depth/, disparity/ or point_cloud/",
    .recognises = has_osd_folders,
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path, kOsdKind.name, list_osd(input.path), options.input);
        },
};

}  // namespace saccade
