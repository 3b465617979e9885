#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <opencv2/core.hpp>

#include "sources/bag_file.hpp"
#include "sources/colour_registration.hpp"

namespace saccade {

/// A sensor_msgs/Image or sensor_msgs/CompressedImage. The bytes are those of the message.
struct RosImage {
  std::int64_t stamp_ns = 0;  ///< of its header; 0 = none
  bool compressed = false;
  std::string
      encoding;  ///< "16UC1", "rgb8", ...; of a compressed one its format: "jpeg", "16UC1; compressedDepth"
  std::uint32_t width = 0, height = 0, step = 0;  ///< of an Image
  bool big_endian = false;
  std::span<const std::uint8_t> data;

  /// Whether the pixels are depth, by the encoding.
  bool is_depth() const;
  /// Whether they are colour or grey of 8 bits.
  bool is_colour() const;
};

/// What the beginning of a message says; `data` is empty. Throws std::runtime_error if it is too short.
RosImage read_ros_image_header(std::span<const std::uint8_t> message, const BagTopic& topic);

/// Throws std::runtime_error with the reason.
RosImage read_ros_image(std::span<const std::uint8_t> message, const BagTopic& topic);

/// A sensor_msgs/CameraInfo. Both cameras are of the images as they were sent: binned, and the part of the
/// sensor that was read.
struct RosCamera {
  LensCamera lens;                ///< of raw images; all distortion 0 if its model is another one
  Intrinsics rectified;           ///< of images whose distortion was taken out; not valid(): none is named
  std::string distortion_model;   ///< "plumb_bob", "rational_polynomial", "equidistant", ...
  bool distorted = false;         ///< some number of the distortion is not 0
  bool knows_distortion = false;  ///< the model is that of LensCamera
};

/// std::nullopt if the message names no camera. Throws std::runtime_error.
std::optional<RosCamera> read_ros_camera(std::span<const std::uint8_t> message, const BagTopic& topic);

/// The camera of the same images in another size. The borders of the image stay where they are, so that the
/// centre of the top-left pixel moves.
Intrinsics scaled_camera(const Intrinsics& camera, double across, double down);

/// The size of a depth image, by its header. Throws std::runtime_error with the reason if it is no depth, its
/// size is refused by check_image_size(), or its data are too short.
cv::Size ros_depth_size(const RosImage& image);

/// The depth of an image, 0 = no reading. `unit_mm`: mm of a unit, if a user named it; 0: 16-bit pixels are
/// in mm and floats in metres. Throws std::runtime_error with the reason.
void ros_depth(const RosImage& image, double unit_mm, cv::Mat1f& depth_mm);

/// Its colour, BGR. Throws std::runtime_error with the reason.
cv::Mat3b ros_colour(const RosImage& image);

}  // namespace saccade
