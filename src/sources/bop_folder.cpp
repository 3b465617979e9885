// A scene of BOP, the benchmark of object poses: depth/, rgb/, mask_visib/ and scene_camera.json.
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

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr const char* kCameras = "scene_camera.json";

class SceneCameras {
 public:
  explicit SceneCameras(const fs::path& file) : file_(file) {
    const auto bytes = read_file(file, 256u << 20);
    json_ = Json::parse(bytes.begin(), bytes.end(), nullptr, /*allow_exceptions=*/false);
    if (!json_.is_object() || json_.empty()) throw broken("not an object of frames");
  }

  // Of a frame; nullptr if the file does not name it.
  const Json* find(std::int64_t frame) const {
    const auto found = json_.find(std::to_string(frame));
    return found != json_.end() && found->is_object() ? &*found : nullptr;
  }

  Intrinsics camera(const Json& frame) const {
    const auto k = numbers<9>(frame, "cam_K");
    const Intrinsics camera{k[0], k[4], k[2], k[5], IntrinsicsOrigin::file};
    if (!camera.valid()) throw broken("cam_K is no camera");
    return camera;
  }

  // mm per unit.
  double depth_scale(const Json& frame) const {
    const auto found = frame.find("depth_scale");
    if (found == frame.end()) return 1;
    const double scale = found->is_number() ? found->get<double>() : 0;
    if (!(scale > 0 && scale <= 1e4)) throw broken("depth_scale is not above 0");
    return scale;
  }

  std::optional<cv::Affine3d> pose(const Json& frame) const {
    if (!frame.contains("cam_R_w2c") || !frame.contains("cam_t_w2c")) return std::nullopt;
    const auto r = numbers<9>(frame, "cam_R_w2c");
    const auto t = numbers<3>(frame, "cam_t_w2c");
    return cv::Affine3d(cv::Matx33d(r.data()), cv::Vec3d(t[0], t[1], t[2])).inv();
  }

 private:
  Error broken(const std::string& why) const {
    return unreadable(fmt::format("broken {}: {}", kCameras, why), file_.string(), "fix it");
  }

  template <std::size_t N>
  std::array<double, N> numbers(const Json& frame, const char* key) const {
    const auto found = frame.find(key);
    const auto is_number = [](const Json& value) { return value.is_number(); };
    if (found == frame.end() || !found->is_array() || found->size() != N ||
        !std::ranges::all_of(*found, is_number))
      throw broken(fmt::format("{} is not {} numbers", key, N));
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i) values[i] = (*found)[i].get<double>();
    return values;
  }

  fs::path file_;
  Json json_;
};

// The masks of each frame: "000012_000003.png" is of object 3 in frame 12.
std::map<std::int64_t, std::vector<fs::path>> list_masks(const fs::path& folder) {
  std::map<std::int64_t, std::vector<fs::path>> masks;
  for (const auto& [stem, path] : files_of(folder, {".png"}))
    if (const auto frame = first_number(stem)) masks[*frame].push_back(path);
  return masks;
}

FolderListing list_bop(const fs::path& folder) {
  const SceneCameras cameras(folder / kCameras);
  const auto colour = files_of(folder / "rgb", kColourEndings),
             grey = files_of(folder / "gray", kColourEndings);
  auto masks = list_masks(folder / "mask_visib");
  std::map<std::int64_t, FolderEntry> found;
  std::optional<double> unit;
  std::size_t without = 0;
  for (const auto& [stem, path] : files_of(folder / "depth", {".png"})) {
    const auto number = first_number(stem);
    if (!number) continue;
    FolderEntry entry;
    entry.name = stem;
    entry.depth = path;
    if (const auto same = colour.find(stem); same != colour.end()) entry.colour = same->second;
    if (const auto same = grey.find(stem); entry.colour.empty() && same != grey.end())
      entry.colour = same->second;
    if (const auto of_frame = masks.find(*number); of_frame != masks.end()) entry.masks = of_frame->second;
    if (const Json* camera = cameras.find(*number)) {
      entry.intrinsics = cameras.camera(*camera);
      entry.camera_to_world = cameras.pose(*camera);
      const double scale = cameras.depth_scale(*camera);
      if (unit.value_or(scale) != scale)
        throw unreadable("frames with different depth_scale", (folder / kCameras).string(),
                         "split the scene by depth_scale");
      unit = scale;
    } else {
      ++without;
    }
    found.emplace(*number, std::move(entry));
  }
  if (found.empty())
    throw unreadable("no frames in the folder", (folder / "depth").string(), "expected NNNNNN.png");
  FolderListing listing = list_by_number(std::move(found));
  listing.mm_per_unit = unit.value_or(1);
  listing.camera = listing.entries.front().intrinsics;
  if (without > 0) listing.notes.push_back(fmt::format("{} frames are not in {}", without, kCameras));
  return listing;
}

bool has_scene_camera(const SourceInput& input) {
  std::error_code code;
  return input.type == SourceInput::Type::folder && fs::exists(input.path / kCameras, code) &&
         fs::is_directory(input.path / "depth", code);
}

}  // namespace

extern const SourceKind kBopKind = {
    .name = "bop",
    .written = "FOLDER",
    .help = "a scene of BOP: depth/, rgb/, mask_visib/ and the cameras of its frames",
    .recognised_by = "scene_camera.json beside depth/",
    .recognises = has_scene_camera,
    .open =
        [](const SourceInput& input, const SourceOptions& options) {
          return open_folder(input, input.path, kBopKind.name, list_bop(input.path), options.input);
        },
};

}  // namespace saccade
