#include "output/frame_writer.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/png.hpp"
#include "output/cloud_files.hpp"
#include "output/colour_map.hpp"
#include "output/tiff.hpp"

namespace saccade {
namespace {

bool is_number(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// Ends of names after the number of the frame.
constexpr std::string_view kMap = "saliency.tiff", kMapPicture = "saliency.png", kNormals = "normals.tiff",
                           kMasks = "masks.png", kLabels = "labels.png", kOverlay = "overlay.png";
constexpr std::string_view kLevel = "level", kLevelEnding = ".tiff";  // with the number of the level between

// Whether this is a map or picture of write_frame(): "000012_saliency.tiff". Not depth, colour and clouds:
// they may be the only copy of a recording.
bool is_frame_file(std::string_view name) {
  const auto line = name.find('_');
  if (line < 6 || line == std::string_view::npos || !is_number(name.substr(0, line))) return false;
  std::string_view ending = name.substr(line + 1);
  for (const auto known : {kMap, kMapPicture, kNormals, kMasks, kLabels, kOverlay})
    if (ending == known) return true;
  if (!ending.starts_with(kLevel) || !ending.ends_with(kLevelEnding)) return false;
  ending.remove_prefix(kLevel.size());
  return ending.size() > kLevelEnding.size() &&
         is_number(ending.substr(0, ending.size() - kLevelEnding.size()));
}

}  // namespace

void write_frame(const std::filesystem::path& folder, const Result& result, const std::set<std::string>& dump,
                 int first_level, DatasetWriter& dataset, const OverlayStyle& style) {
  const auto path = [&](std::string_view ending) { return folder / frame_file(result.frame.index, ending); };
  const SaliencyMaps& maps = result.maps;
  if (dump.contains("maps")) {
    write_file(path(kMap), encode_tiff(maps.master));
    write_file(path(kMapPicture), encode_png(to_grey(maps.master)));
  }
  const Frame& frame = result.frame;
  if (dump.contains("depth")) dataset.write_depth(frame);
  if (dump.contains("colour")) dataset.write_colour(frame);
  if (dump.contains("cloud")) write_file(path("cloud.ply"), encode_ply(frame, maps.normals));
  if (dump.contains("levels"))
    for (std::size_t i = 0; i < maps.levels.size(); ++i)
      write_file(path(fmt::format("{}{}{}", kLevel, first_level + static_cast<int>(i), kLevelEnding)),
                 encode_tiff(maps.levels[i]));
  if (dump.contains("normals")) write_file(path(kNormals), encode_tiff(maps.normals));
  if (dump.contains("masks")) {
    const bool none = result.attention.masks.empty();
    write_file(path(kMasks),
               encode_png(none ? cv::Mat1w(result.frame.size(), std::uint16_t{0}) : result.attention.masks));
  }
  if (const cv::Mat1w& labels = result.frame.truth.labels; dump.contains("labels") && !labels.empty())
    write_file(path(kLabels), encode_png(labels));
  if (dump.contains("overlay"))
    write_file(path(kOverlay), encode_png(draw_overlay(result.frame, maps.master, result.attention, style)));
}

void remove_frame_files(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code code;
  std::vector<fs::path> files;
  for (fs::directory_iterator file(folder, code), end; !code && file != end; file.increment(code))
    if (is_frame_file(file->path().filename().string())) files.push_back(file->path());
  for (const fs::path& file : files)
    if (!fs::remove(file, code) && code)
      throw failed("cannot remove a file of an earlier run: " + code.message(), file.string(),
                   "choose another --out");
}

}  // namespace saccade
