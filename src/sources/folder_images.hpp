#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "oni/jpeg.hpp"

namespace saccade {

/// How the depth files of a folder are understood.
struct DepthForm {
  double mm_per_unit = 1;     ///< of 16-bit images
  double mm_per_real = 1000;  ///< of points, which are in metres unless a user says otherwise
  /// Points are multiples of this (mm), and lost their last bits in the file; 0 = they may be anything.
  double cloud_unit_mm = 0;
  bool rotated_bits = false;  ///< 16-bit images are rotated left by 3 bits (SUN RGB-D)
};

/// Whether a file is a point cloud by its ending: .pcd or .ply.
bool is_cloud(const std::filesystem::path& path);

/// Whether a file begins as a PNG of 16-bit grey; false if it cannot be read.
bool is_depth_png(const std::filesystem::path& path);

/// The size of a depth image or cloud, by its header. Throws std::runtime_error with the reason if it cannot
/// be used: it is broken, not 16-bit grey, below 8 pixels a side, or refused by check_image_size().
cv::Size read_depth_size(const std::filesystem::path& path);

/// Reads a depth image or cloud of this size; 0 = no reading. `colour` becomes that of the points of a cloud,
/// if it has any, else empty. Throws std::runtime_error with the reason; the size is checked before the image
/// is decoded.
void read_depth_file(const std::filesystem::path& path, cv::Size size, const DepthForm& form,
                     cv::Mat1f& depth_mm, cv::Mat3b& colour);

/// The stored values of a 16-bit grey PNG. Throws std::runtime_error with the reason.
cv::Mat1w read_depth_png(const std::filesystem::path& path);

/// The camera that a cloud names or that fits its points; std::nullopt if there is none. Throws
/// std::runtime_error with the reason if the cloud is broken.
std::optional<Intrinsics> read_cloud_camera(const std::filesystem::path& path);

/// Reads colour images: PNG (16 bits become 8, grey becomes colour) and JPEG.
class ColourReader {
 public:
  /// The image, scaled to `size`. Throws std::runtime_error with the reason.
  cv::Mat3b read(const std::filesystem::path& path, cv::Size size);

  /// The size of the image in the file. Throws std::runtime_error with the reason.
  static cv::Size read_size(const std::filesystem::path& path);

 private:
  JpegCodec jpeg_;
};

/// Reads a label image of this size: grey or palette, or, if `colours_are_labels`, each colour but black is a
/// label, in the order of their values. Throws std::runtime_error with the reason.
cv::Mat1w read_label_image(const std::filesystem::path& path, cv::Size size, bool colours_are_labels);

/// Labels from one image of this size for each object, in the order of `masks`: 1, 2, ... where they are not
/// 0; the later object covers the earlier. Throws std::runtime_error with the reason.
cv::Mat1w read_masks(const std::vector<std::filesystem::path>& masks, cv::Size size);

}  // namespace saccade
