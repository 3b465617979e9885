#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "sources/bag_file.hpp"

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

/// The camera of a sensor_msgs/CameraInfo; std::nullopt if it names none. Throws std::runtime_error.
std::optional<Intrinsics> read_ros_camera(std::span<const std::uint8_t> message, const BagTopic& topic);

/// The depth of an image, 0 = no reading; `unit_mm` is that of 16-bit pixels, floats are in metres. Throws
/// std::runtime_error with the reason.
void ros_depth(const RosImage& image, double unit_mm, cv::Mat1f& depth_mm);

/// Its colour, BGR. Throws std::runtime_error with the reason.
cv::Mat3b ros_colour(const RosImage& image);

}  // namespace saccade
