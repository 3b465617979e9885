// Folders of images side by side: depth/ with color/, rgb/ or image/. Redwood and Open3D, exports of ScanNet,
// OCID, SUN RGB-D.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "sources/folder_files.hpp"
#include "sources/numbered_frames.hpp"
#include "sources/poses_file.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string_view> kColourFolders = {"color", "colour", "rgb", "image", "image_color"};
const std::vector<std::string_view> kLabelFolders = {"label", "labels", "annotation"};
const std::vector<std::string_view> kPoseFolders = {"pose", "poses"};

bool is_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code);
}

// Open3D: {"intrinsic_matrix": [fx, 0, 0, 0, fy, 0, cx, cy, 1]}, column by column.
Intrinsics read_open3d_camera(const fs::path& file) {
  const auto bytes = read_file(file, 1u << 20);
  const auto json = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
  const auto broken = [&] {
    return unreadable("no intrinsic_matrix of 9 numbers", file.string(), "fix or delete it");
  };
  if (!json.is_object() || !json.contains("intrinsic_matrix")) throw broken();
  const auto& matrix = json["intrinsic_matrix"];
  const auto is_number = [](const auto& value) { return value.is_number(); };
  if (!matrix.is_array() || matrix.size() != 9 || !std::ranges::all_of(matrix, is_number)) throw broken();
  const Intrinsics camera{matrix[0].get<double>(), matrix[4].get<double>(), matrix[6].get<double>(),
                          matrix[7].get<double>(), IntrinsicsOrigin::file};
  if (!camera.valid()) throw broken();
  return camera;
}

std::optional<Intrinsics> find_camera(const fs::path& folder) {
  for (const char* name : {"intrinsic/intrinsic_depth.txt", "intrinsics_depth.txt", "intrinsics.txt"})
    if (is_there(folder / name)) return read_camera_matrix(folder / name);
  for (const char* name : {"intrinsic.json", "camera_intrinsic.json", "camera_primesense.json"})
    if (is_there(folder / name)) return read_open3d_camera(folder / name);
  return std::nullopt;
}

// A frame of SUN RGB-D: its depth images are rotated by 3 bits.
bool is_sun_rgbd(const fs::path& folder) {
  return is_there(folder / "intrinsics.txt") && is_there(folder / "image") &&
         (is_there(folder / "depth_bfx") || is_there(folder / "seg.mat") || is_there(folder / "scene.txt"));
}

// Finds the companions of depth images: by the same stem, else by the first number in the name, else the only
// file there is.
class Companions {
 public:
  explicit Companions(FilesByStem files) : files_(std::move(files)) {
    for (const auto& [stem, path] : files_)
      if (const auto number = first_number(stem)) by_number_.emplace(*number, path);
  }

  fs::path of(const std::string& stem, bool only_one) const {
    if (const auto same = files_.find(stem); same != files_.end()) return same->second;
    const auto number = first_number(stem);
    if (number && by_number_.contains(*number)) return by_number_.at(*number);
    return only_one && files_.size() == 1 ? files_.begin()->second : fs::path();
  }

 private:
  FilesByStem files_;
  std::map<std::int64_t, fs::path> by_number_;
};

FolderListing list_paired(const fs::path& folder) {
  const FilesByStem depth = files_of(folder / "depth", {".png"});
  if (depth.empty())
    throw unreadable("no frames in the folder", (folder / "depth").string(), "expected 16-bit PNG");
  const bool only_one = depth.size() == 1;
  const auto companions = [&](const std::vector<std::string_view>& names,
                              const std::vector<std::string>& endings) {
    const fs::path found = first_folder(folder, names);
    return Companions(found.empty() ? FilesByStem{} : files_of(found, endings));
  };
  const Companions colour = companions(kColourFolders, kColourEndings);
  const Companions labels = companions(kLabelFolders, {".png"});
  const Companions poses = companions(kPoseFolders, {".txt"});
  std::map<std::int64_t, FolderEntry> numbered;
  FramePoses frame_poses;
  for (const auto& [stem, path] : depth) {
    FolderEntry entry;
    entry.name = stem;
    entry.depth = path;
    entry.colour = colour.of(stem, only_one);
    entry.label = labels.of(stem, only_one);
    entry.camera_to_world = frame_poses.read(poses.of(stem, only_one));
    const auto number = first_number(stem);
    const auto next = numbered.empty() ? 0 : numbered.rbegin()->first + 1;
    // Names whose numbers do not count up are taken in their order.
    numbered.emplace(number && *number >= next ? *number : next, std::move(entry));
  }
  FolderListing listing = list_by_number(std::move(numbered));
  frame_poses.add_note(listing.notes);
  bool posed = frame_poses.any();
  const fs::path trajectory = folder / "trajectory.log";
  if (!posed && is_there(trajectory))
    for (const auto& [position, pose] : read_trajectory(trajectory))
      if (position < std::ssize(listing.entries)) {
        listing.entries[static_cast<std::size_t>(position)].camera_to_world = pose;
        posed = true;
      }
  listing.sequence = posed;
  listing.camera = find_camera(folder);
  listing.colours_are_labels = true;
  listing.rotated_bits = is_sun_rgbd(folder);
  if (listing.rotated_bits)
    listing.notes.emplace_back("depth is that of SUN RGB-D: its bits are rotated back");
  return listing;
}

bool has_pairs(const SourceInput& input) {
  std::error_code code;
  return input.type == SourceInput::Type::folder && fs::is_directory(input.path / "depth", code) &&
         !first_folder(input.path, kColourFolders).empty();
}

}  // namespace

extern const SourceKind kPairedKind = {
    .name = "paired",
    .written = "FOLDER",
    .help = "depth/ with color/, rgb/ or image/: Redwood, Open3D, ScanNet, OCID, SUN RGB-D",
    .recognised_by = "color/, colour/, rgb/ or image/ beside depth/",
    .recognises = has_pairs,
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path, kPairedKind.name, list_paired(input.path), options.input);
        },
};

}  // namespace saccade
