// Organised point clouds: a folder of them, or one.
#include <map>
#include <string>

#include "core/error.hpp"
#include "sources/folder_files.hpp"
#include "sources/folder_images.hpp"
#include "sources/numbered_frames.hpp"
#include "sources/times_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kCloudEndings[] = {".pcd", ".ply"};

// The image beside NAME.pcd: NAME.png or .jpg, or NNNN_rgb.png beside NNNN_cloud.pcd; empty if there is none.
// A PNG of 16-bit grey is the depth of the cloud, not its colour.
fs::path colour_beside(const FolderNames& names, const std::string& stem) {
  const std::string frame = stem.substr(0, stem.find("_cloud"));
  const fs::path path = names.first_of({stem + ".png", stem + ".jpg", stem + ".jpeg", frame + "_rgb.png",
                                        frame + "_rgb.jpg", frame + "_rgb.jpeg"});
  return path.empty() || is_depth_png(path) ? fs::path() : path;
}

FolderListing list_clouds(const fs::path& folder) {
  std::map<std::int64_t, FolderEntry> found;
  const FolderNames names(folder);
  for (const std::string& name : names.all()) {
    const fs::path path = folder / name;
    if (!is_cloud(path)) continue;
    const std::string stem = path.stem().string();
    const auto number = last_number(stem);
    if (!number) throw unreadable("a cloud without a number in its name", path.string(), "number the files");
    FolderEntry entry;
    entry.name = stem.substr(0, stem.find("_cloud"));
    entry.depth = path;
    entry.colour = colour_beside(names, stem);
    if (!found.emplace(*number, entry).second)
      throw unreadable("two clouds have the same number", path.string(), "rename or delete one");
  }
  const fs::path first = found.begin()->second.depth;
  FolderListing listing = list_by_number(std::move(found), read_times(folder / "times.txt"));
  listing.cloud = first;
  return listing;
}

FolderListing list_one(const fs::path& file) {
  FolderListing listing;
  FolderEntry entry;
  entry.name = file.stem().string();
  entry.depth = file;
  entry.colour = colour_beside(FolderNames(file.parent_path()), entry.name);
  listing.entries.push_back(std::move(entry));
  listing.cloud = file;
  return listing;
}

bool has_clouds(const SourceInput& input) {
  if (input.type != SourceInput::Type::folder) return false;
  std::error_code code;
  for (fs::directory_iterator file(input.path, code), end; !code && file != end; file.increment(code))
    if (is_cloud(file->path())) return true;
  return false;
}

}  // namespace

extern const SourceKind kCloudsKind = {
    .name = "clouds",
    .written = "FOLDER or FILE.pcd",
    .help =
        "organised point clouds: numbered .pcd, or .ply as export writes them, with colour; or a single one",
    .recognised_by = "a file that ends in .pcd or .ply",
    .endings = kCloudEndings,
    .recognises = has_clouds,
    .open = [](const SourceInput& input, const SourceOptions& options) -> std::unique_ptr<FrameSource> {
      if (input.type == SourceInput::Type::folder)
        return open_folder(input, input.path, kCloudsKind.name, list_clouds(input.path), options.input);
      return open_folder(input, input.path.parent_path(), kCloudsKind.name, list_one(input.path),
                         options.input);
    },
};

}  // namespace saccade
