#include "output/frame_writer.hpp"

#include <algorithm>
#include <array>
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

// Whether this is a map or picture of write_frame(): "000012_saliency.tiff". Not depth, colour and clouds:
// they may be the only copy of a recording.
bool is_frame_file(std::string_view name) {
  constexpr std::array<std::string_view, 6> kEndings = {"saliency.tiff", "saliency.png", "normals.tiff",
                                                        "masks.png",     "labels.png",   "overlay.png"};
  constexpr std::string_view kLevel = "level", kTiff = ".tiff";
  const auto line = name.find('_');
  if (line < 6 || line == std::string_view::npos || !is_number(name.substr(0, line))) return false;
  std::string_view ending = name.substr(line + 1);
  if (std::ranges::count(kEndings, ending) > 0) return true;
  if (!ending.starts_with(kLevel) || !ending.ends_with(kTiff)) return false;
  ending.remove_prefix(kLevel.size());
  return ending.size() > kTiff.size() && is_number(ending.substr(0, ending.size() - kTiff.size()));
}

}  // namespace

void write_frame(const std::filesystem::path& folder, const Result& result, const std::set<std::string>& dump,
                 int first_level, DatasetWriter& dataset, const OverlayStyle& style) {
  const auto path = [&](const std::string& ending) {
    return folder / frame_file(result.frame.index, ending);
  };
  const SaliencyMaps& maps = result.maps;
  if (dump.contains("maps")) {
    write_file(path("saliency.tiff"), encode_tiff(maps.master));
    write_file(path("saliency.png"), encode_png(to_grey(maps.master)));
  }
  const Frame& frame = result.frame;
  if (dump.contains("depth")) dataset.write_depth(frame);
  if (dump.contains("colour")) dataset.write_colour(frame);
  if (dump.contains("cloud")) write_file(path("cloud.ply"), encode_ply(frame, maps.normals));
  if (dump.contains("levels"))
    for (std::size_t i = 0; i < maps.levels.size(); ++i)
      write_file(path(fmt::format("level{}.tiff", first_level + static_cast<int>(i))),
                 encode_tiff(maps.levels[i]));
  if (dump.contains("normals")) write_file(path("normals.tiff"), encode_tiff(maps.normals));
  if (dump.contains("masks")) {
    const bool none = result.attention.masks.empty();
    write_file(path("masks.png"),
               encode_png(none ? cv::Mat1w(result.frame.size(), std::uint16_t{0}) : result.attention.masks));
  }
  if (const cv::Mat1w& labels = result.frame.truth.labels; dump.contains("labels") && !labels.empty())
    write_file(path("labels.png"), encode_png(labels));
  if (dump.contains("overlay"))
    write_file(path("overlay.png"),
               encode_png(draw_overlay(result.frame, maps.master, result.attention, style)));
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
