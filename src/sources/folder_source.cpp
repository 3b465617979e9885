#include "sources/folder_source.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/image_size.hpp"
#include "core/outcome.hpp"
#include "core/png.hpp"
#include "oni/jpeg.hpp"
#include "sources/meta_json.hpp"
#include "sources/pcd.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

constexpr int kSmallestSide = 8;

// Whether a depth image of this form can be used.
Outcome usable(const PngHeader& header) {
  const auto [width, height] = header.size;
  if (header.bits != 16 || header.channels != "grey")
    return Outcome::failure(fmt::format("{}-bit {} is not 16-bit grey depth", header.bits, header.channels));
  if (width < kSmallestSide || height < kSmallestSide)
    return Outcome::failure(
        fmt::format("{}x{} is smaller than {} pixels a side", width, height, kSmallestSide));
  return Outcome::success();
}

// More than the largest image takes as a PNG, or as a cloud of 48 bytes a point.
std::vector<std::uint8_t> read_image_file(const fs::path& path) {
  constexpr std::uintmax_t kLargest = 50 * kMostPixels;
  return read_file(path, kLargest);
}

bool is_cloud(const fs::path& path) { return ending_of(path) == ".pcd"; }

// Labels of a coloured image: black is no object; the other colours, in the order of their values, are
// 1, 2, ..
cv::Mat1w labels_of_colours(const cv::Mat3b& image) {
  constexpr std::size_t kMost = 65535;
  std::map<int, std::uint16_t> labels;
  const auto code = [](const cv::Vec3b& bgr) { return bgr[2] << 16 | bgr[1] << 8 | bgr[0]; };
  for (const cv::Vec3b& pixel : image) labels.emplace(code(pixel), std::uint16_t{0});
  labels.erase(0);
  if (labels.size() > kMost) throw std::runtime_error("too many colours for labels");
  std::uint16_t next = 0;
  for (auto& [colour, label] : labels) label = ++next;
  labels.emplace(0, std::uint16_t{0});
  cv::Mat1w out(image.size());
  std::transform(image.begin(), image.end(), out.begin(),
                 [&](const cv::Vec3b& pixel) { return labels.at(code(pixel)); });
  return out;
}

std::string plain(cv::Size size) { return fmt::format("{}x{}", size.width, size.height); }

class FolderSource final : public FrameSource {
 public:
  FolderSource(const SourceInput& input, const fs::path& folder, std::string_view kind, FolderListing listing)
      : listing_(std::move(listing)) {
    info_.uri = input.uri;
    info_.kind = kind;
    info_.size = first_size();
    info_.frame_count = static_cast<std::int64_t>(listing_.entries.size());
    info_.rate_hz = listing_.rate_hz;
    info_.sequence = listing_.sequence;
    info_.notes = listing_.notes;
    auto camera = read_meta(folder);
    if (!camera) camera = camera_of_cloud();
    info_.intrinsics = camera ? *camera : Intrinsics::guess_for(info_.size);
    if (listing_.scales_colour) note_scaled_colour();
  }

  const SourceInfo& info() const override { return info_; }

  void seek(std::int64_t index) override { next_ = index; }

  ReadResult read(Frame& frame, std::chrono::milliseconds) override {
    if (next_ < 0 || next_ >= info_.frame_count) return {ReadStatus::end, ""};
    const FolderEntry& entry = listing_.entries[static_cast<std::size_t>(next_)];
    frame.index = next_++;
    frame.timestamp_us = entry.timestamp_us;
    frame.name = entry.name;
    frame.intrinsics = info_.intrinsics;
    frame.truth.normals.release();
    frame.truth.camera_to_world = entry.camera_to_world;
    fs::path current = entry.depth;
    try {
      read_depth(current, frame);
      read_colour(current = entry.colour, frame);
      read_labels(current = entry.label, frame);
      read_classes(current = entry.classes, frame);
    } catch (const std::runtime_error& error) {  // an Error, or the reason of a decoder
      return {ReadStatus::rejected, fmt::format("{}: {}", current.filename().string(), error.what())};
    }
    return {ReadStatus::frame, ""};
  }

 private:
  // The size of a depth image or cloud. Throws std::runtime_error if it cannot be used.
  static cv::Size depth_size(const fs::path& path, std::span<const std::uint8_t> bytes) {
    if (is_cloud(path)) return read_pcd_size(bytes);
    const PngHeader header = read_png_header(bytes);
    if (const Outcome outcome = usable(header); !outcome) throw std::runtime_error(outcome.reason());
    return header.size;
  }

  // All frames have one size: that of the first whose header makes sense.
  cv::Size first_size() const {
    std::optional<std::string> first_problem;
    for (const FolderEntry& entry : listing_.entries) try {
        return depth_size(entry.depth, read_image_file(entry.depth));
      } catch (const std::runtime_error& error) {
        if (!first_problem) first_problem = entry.depth.filename().string() + ": " + error.what();
      }
    throw unreadable("no usable depth image; " + first_problem.value_or(""), info_.uri,
                     "depth must be 16-bit grey PNG in mm or an organised PCD, at least 8 pixels a side");
  }

  // By the first colour image that can be read.
  void note_scaled_colour() {
    for (const FolderEntry& entry : listing_.entries) try {
        if (entry.colour.empty()) continue;
        const cv::Size size = colour_size(entry.colour, read_image_file(entry.colour));
        if (size != info_.size)
          info_.notes.push_back(
              fmt::format("colour of {} is scaled to the depth's {}", plain(size), plain(info_.size)));
        return;
      } catch (const std::runtime_error&) {
        // The frame is rejected when it is read.
      }
  }

  std::optional<Intrinsics> camera_of_cloud() {
    if (listing_.cloud.empty()) return std::nullopt;
    try {
      return read_pcd(read_image_file(listing_.cloud)).intrinsics;
    } catch (const std::runtime_error& error) {
      info_.notes.push_back(fmt::format("{}: {}", listing_.cloud.filename().string(), error.what()));
      return std::nullopt;
    }
  }

  void read_depth(const fs::path& path, Frame& frame) const {
    const auto bytes = read_image_file(path);
    const cv::Size size = depth_size(path, bytes);
    if (size != info_.size)
      throw std::runtime_error(fmt::format("{}, but the first frame is {}", plain(size), plain(info_.size)));
    if (is_cloud(path))
      frame.depth_mm = read_pcd(bytes).depth_mm;
    else
      decode_png(bytes).convertTo(frame.depth_mm, CV_32F, listing_.mm_per_unit);
  }

  void check_size(cv::Size size) const {
    if (size != info_.size)
      throw std::runtime_error(fmt::format("{}, but the depth is {}", plain(size), plain(info_.size)));
  }

  // The size is checked before the image is decoded.
  void read_colour(const fs::path& path, Frame& frame) {
    frame.colour.release();
    if (path.empty()) return;
    const auto bytes = read_image_file(path);
    const cv::Size size = colour_size(path, bytes);
    if (!listing_.scales_colour) check_size(size);
    cv::Mat3b image = is_png(path) ? decode_colour_png(bytes) : decode_jpeg(bytes, size);
    if (size != info_.size) cv::resize(image, image, info_.size, 0, 0, cv::INTER_AREA);
    frame.colour = image;
  }

  static cv::Mat3b decode_colour_png(std::span<const std::uint8_t> bytes) {
    cv::Mat image = decode_png(bytes);
    if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1.0 / 256);
    if (image.channels() == 1) cv::merge(std::vector<cv::Mat>(3, image), image);
    return image;
  }

  static bool is_png(const fs::path& path) { return ending_of(path) == ".png"; }

  static cv::Size colour_size(const fs::path& path, std::span<const std::uint8_t> bytes) {
    if (is_png(path)) return read_png_header(bytes).size;
    const auto size = jpeg_size(bytes);
    if (!size) throw std::runtime_error("not a JPEG image");
    check_image_size(size->width, size->height);
    return *size;
  }

  cv::Mat3b decode_jpeg(std::span<const std::uint8_t> bytes, cv::Size size) {
    cv::Mat3b image;
    if (const Outcome decoded = jpeg_.decode(bytes, size, image); !decoded)
      throw std::runtime_error(decoded.reason());
    return image;
  }

  // A label or class image. The size is checked before it is decoded.
  cv::Mat read_truth(const fs::path& path) const {
    const auto bytes = read_image_file(path);
    check_size(read_png_header(bytes).size);
    return decode_png(bytes);
  }

  void read_labels(const fs::path& path, Frame& frame) const {
    frame.truth.labels.release();
    if (path.empty()) return;
    const cv::Mat image = read_truth(path);
    if (image.channels() != 1) {
      if (!listing_.colours_are_labels) throw std::runtime_error("labels must be grey or palette");
      frame.truth.labels = labels_of_colours(image);
      return;
    }
    image.convertTo(frame.truth.labels, CV_16U);
  }

  void read_classes(const fs::path& path, Frame& frame) const {
    frame.truth.classes.release();
    if (path.empty()) return;
    const cv::Mat image = read_truth(path);
    if (image.channels() != 1) throw std::runtime_error("classes must be grey or palette");
    image.convertTo(frame.truth.classes, CV_16U);
  }

  FolderListing listing_;
  SourceInfo info_;
  JpegCodec jpeg_;
  std::int64_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_folder(const SourceInput& input, const fs::path& folder,
                                         std::string_view kind, FolderListing listing) {
  return std::make_unique<FolderSource>(input, folder, kind, std::move(listing));
}

}  // namespace saccade
