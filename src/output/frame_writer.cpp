#include "output/frame_writer.hpp"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/png.hpp"
#include "output/colour_map.hpp"

namespace saccade {
namespace {

// Uncompressed, for any reader.
void write_tiff(const std::filesystem::path& path, const cv::Mat& image) {
  constexpr int kNoCompression = 1;
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".tiff", image, bytes, {cv::IMWRITE_TIFF_COMPRESSION, kNoCompression}))
    throw failed("cannot encode TIFF", path.string(), "is there enough memory?");
  write_file(path, bytes);
}

}  // namespace

void write_frame(const std::filesystem::path& folder, const Result& result, const std::set<std::string>& dump,
                 int first_level, const OverlayStyle& style) {
  const auto path = [&](const std::string& ending) {
    return folder / fmt::format("{:06}_{}", result.frame.index, ending);
  };
  const SaliencyMaps& maps = result.maps;
  if (dump.contains("maps")) {
    write_tiff(path("saliency.tiff"), maps.master);
    write_file(path("saliency.png"), encode_png(to_grey(maps.master)));
  }
  if (dump.contains("levels"))
    for (std::size_t i = 0; i < maps.levels.size(); ++i)
      write_tiff(path(fmt::format("level{}.tiff", first_level + static_cast<int>(i))), maps.levels[i]);
  if (dump.contains("normals")) {
    cv::Mat3f xyz;  // the encoder expects B, G, R and reverses the channels
    cv::cvtColor(maps.normals, xyz, cv::COLOR_BGR2RGB);
    write_tiff(path("normals.tiff"), xyz);
  }
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

}  // namespace saccade
