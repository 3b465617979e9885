#include "sources/folder_images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/depth_units.hpp"
#include "core/file.hpp"
#include "core/fit_colour.hpp"
#include "core/image_size.hpp"
#include "core/outcome.hpp"
#include "core/png.hpp"
#include "sources/pcd.hpp"
#include "sources/ply.hpp"
#include "sources/source_kind.hpp"

namespace saccade {
namespace fs = std::filesystem;
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr int kSmallestSide = 8;

void check_smallest(cv::Size size) {
  if (size.width < kSmallestSide || size.height < kSmallestSide)
    throw std::runtime_error(
        fmt::format("{}x{} is smaller than {} pixels a side", size.width, size.height, kSmallestSide));
}

// The header of a depth image that can be used.
PngHeader check_depth_png(Bytes bytes) {
  PngHeader header = read_png_header(bytes);
  if (header.bits != 16 || header.channels != "grey")
    throw std::runtime_error(fmt::format("{}-bit {} is not 16-bit grey depth", header.bits, header.channels));
  check_smallest(header.size);
  return header;
}

// More than the largest image takes as a PNG, or as a cloud of 48 bytes a point.
std::vector<std::uint8_t> read_image_file(const fs::path& path) {
  constexpr std::uintmax_t kLargest = 50 * kMostPixels;
  return read_file(path, kLargest);
}

bool is_ply(const fs::path& path) { return ending_of(path) == ".ply"; }
bool is_png(const fs::path& path) { return ending_of(path) == ".png"; }

OrganisedCloud read_cloud(const fs::path& path, Bytes bytes) {
  return is_ply(path) ? read_ply(bytes) : read_pcd(bytes);
}

cv::Size depth_size(const fs::path& path, Bytes bytes) {
  if (is_cloud(path)) return is_ply(path) ? read_ply_size(bytes) : read_pcd_size(bytes);
  return check_depth_png(bytes).size;
}

void rotate_bits(cv::Mat1w& stored) {
  for (std::uint16_t& value : stored) value = static_cast<std::uint16_t>(value >> 3 | value << 13);
}

cv::Mat3b decode_colour_png(Bytes bytes) {
  cv::Mat image = decode_png(bytes);
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1.0 / 256);
  if (image.channels() == 1) cv::merge(std::vector<cv::Mat>(3, image), image);
  return image;
}

cv::Size colour_size(const fs::path& path, Bytes bytes) {
  if (is_png(path)) return read_png_header(bytes).size;
  const auto size = jpeg_size(bytes);
  if (!size) throw std::runtime_error("not a JPEG image");
  check_image_size(size->width, size->height);
  return *size;
}

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

}  // namespace

bool is_cloud(const fs::path& path) { return ending_of(path) == ".pcd" || is_ply(path); }

bool is_depth_png(const fs::path& path) {
  constexpr std::size_t kHeader = 64;
  std::array<char, kHeader> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  try {
    const PngHeader header = read_png_header(
        {reinterpret_cast<const std::uint8_t*>(begin.data()), static_cast<std::size_t>(file.gcount())});
    return header.bits == 16 && header.channels == "grey";
  } catch (const std::runtime_error&) {
    return false;
  }
}

cv::Size read_depth_size(const fs::path& path) { return depth_size(path, read_image_file(path)); }

void read_depth_file(const fs::path& path, cv::Size size, const DepthForm& form, cv::Mat1f& depth_mm,
                     cv::Mat3b& colour) {
  colour.release();
  const auto bytes = read_image_file(path);
  if (const cv::Size stored = depth_size(path, bytes); stored != size)
    throw std::runtime_error(fmt::format("{}x{}, but the first frame is {}x{}", stored.width, stored.height,
                                         size.width, size.height));
  if (!is_cloud(path)) {
    cv::Mat1w stored = decode_png(bytes);
    if (form.rotated_bits) rotate_bits(stored);
    return depth_from_units(stored, form.mm_per_unit, depth_mm);
  }
  OrganisedCloud cloud = read_cloud(path, bytes);
  depth_mm = cloud.depth_mm;
  colour = cloud.colour;
  if (form.mm_per_real != 1000) depth_from_reals(depth_mm, form.mm_per_real / 1000, depth_mm);
  const double unit = form.cloud_unit_mm;
  if (unit > 0)
    for (float& depth : depth_mm)
      depth = static_cast<float>(std::round(static_cast<double>(depth) / unit) * unit);
}

cv::Mat1w read_depth_png(const fs::path& path) {
  const auto bytes = read_image_file(path);
  check_depth_png(bytes);
  return decode_png(bytes);
}

std::optional<Intrinsics> read_cloud_camera(const fs::path& path) {
  return read_cloud(path, read_image_file(path)).intrinsics;
}

cv::Size ColourReader::read_size(const fs::path& path) { return colour_size(path, read_image_file(path)); }

cv::Mat3b ColourReader::read(const fs::path& path, cv::Size size) {
  const auto bytes = read_image_file(path);
  const cv::Size stored = colour_size(path, bytes);
  cv::Mat3b image;
  if (is_png(path)) {
    image = decode_colour_png(bytes);
  } else if (const Outcome decoded = jpeg_.decode(bytes, stored, image); !decoded) {
    throw std::runtime_error(decoded.reason());
  }
  if (stored == size) return image;
  cv::Mat3b scaled;
  fit_colour(image, size, scaled);
  return scaled;
}

cv::Mat1w read_label_image(const fs::path& path, cv::Size size, bool colours_are_labels) {
  const auto bytes = read_image_file(path);
  if (const cv::Size stored = read_png_header(bytes).size; stored != size)
    throw std::runtime_error(
        fmt::format("{}x{}, but the depth is {}x{}", stored.width, stored.height, size.width, size.height));
  const cv::Mat image = decode_png(bytes);
  if (image.channels() != 1) {
    if (!colours_are_labels) throw std::runtime_error("labels must be grey or palette");
    return labels_of_colours(image);
  }
  cv::Mat1w labels;
  image.convertTo(labels, CV_16U);
  return labels;
}

cv::Mat1w read_masks(const std::vector<fs::path>& masks, cv::Size size) {
  cv::Mat1w labels(size, std::uint16_t{0});
  std::uint16_t label = 0;
  for (const fs::path& mask : masks) labels.setTo(++label, read_label_image(mask, size, false) != 0);
  return labels;
}

}  // namespace saccade
