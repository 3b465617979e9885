#include "sources/ros_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/depth_units.hpp"
#include "core/image_size.hpp"
#include "core/outcome.hpp"
#include "core/png.hpp"
#include "oni/bytes.hpp"
#include "oni/jpeg.hpp"
#include "sources/rvl.hpp"

namespace saccade {
namespace {

using Bytes = std::span<const std::uint8_t>;
using std::string_view;

// The fields of a message in their order, as ROS 1 writes them or as CDR, which aligns numbers.
class MessageReader {
 public:
  MessageReader(Bytes message, BagEncoding encoding) : bytes_(message), cdr_(encoding == BagEncoding::cdr) {
    if (!cdr_) return;
    constexpr std::size_t kHeader = 4;
    if (bytes_.size() < kHeader) throw too_short();
    if (bytes_[1] != 1) throw std::runtime_error("its message is not little-endian CDR");
    bytes_ = bytes_.subspan(kHeader);
  }

  template <typename T>
  T number() {
    if (cdr_) at_ += (sizeof(T) - at_ % sizeof(T)) % sizeof(T);
    if (at_ > bytes_.size() || bytes_.size() - at_ < sizeof(T)) throw too_short();
    const T value = load_le<T>(bytes_.data() + at_);
    at_ += sizeof(T);
    return value;
  }

  Bytes sequence() {
    const auto size = number<std::uint32_t>();
    if (size > bytes_.size() - at_) throw too_short();
    const Bytes part = bytes_.subspan(at_, size);
    at_ += size;
    return part;
  }

  std::string text() {
    const Bytes part = sequence();
    const auto end = std::ranges::find(part, 0);  // CDR writes the NUL
    return {part.begin(), end};
  }

  std::int64_t stamp_ns() {
    if (!cdr_) static_cast<void>(number<std::uint32_t>());  // seq
    const auto seconds = number<std::uint32_t>();
    const auto nanoseconds = number<std::uint32_t>();
    static_cast<void>(text());  // frame_id
    return std::int64_t{seconds} * 1'000'000'000 + nanoseconds;
  }

 private:
  static std::runtime_error too_short() { return std::runtime_error("its message is too short"); }

  Bytes bytes_;
  bool cdr_;
  std::size_t at_ = 0;
};

RosImage read_image(MessageReader reader, bool compressed, bool with_data) {
  RosImage image;
  image.compressed = compressed;
  image.stamp_ns = reader.stamp_ns();
  if (!compressed) {
    image.height = reader.number<std::uint32_t>();
    image.width = reader.number<std::uint32_t>();
  }
  image.encoding = reader.text();
  if (!compressed) {
    image.big_endian = reader.number<std::uint8_t>() != 0;
    image.step = reader.number<std::uint32_t>();
  }
  if (with_data) image.data = reader.sequence();
  return image;
}

bool is_compressed(const BagTopic& topic) { return topic.type == "sensor_msgs/CompressedImage"; }

constexpr std::array<string_view, 2> kDepth16 = {"16UC1", "mono16"};

// The pixels of an uncompressed image, in place.
cv::Mat pixels_of(const RosImage& image, int type) {
  check_image_size(image.width, image.height);
  if (image.width == 0 || image.height == 0) throw std::runtime_error("an image without pixels");
  if (image.big_endian && CV_ELEM_SIZE1(type) > 1) throw std::runtime_error("its pixels are big-endian");
  const std::size_t row = std::size_t{image.width} * static_cast<std::size_t>(CV_ELEM_SIZE(type));
  if (image.step < row || image.data.size() / image.step < image.height)
    throw std::runtime_error(
        fmt::format("{} bytes are too few for {}x{} pixels", image.data.size(), image.width, image.height));
  return {static_cast<int>(image.height), static_cast<int>(image.width), type,
          const_cast<std::uint8_t*>(image.data.data()), image.step};
}

// A PNG, or the size of the image (columns, rows: 32 bits each) and its pixels by RVL.
cv::Mat1w decode_compressed_depth(Bytes data, bool rvl) {
  if (!rvl) {
    const cv::Mat png = decode_png(data);
    if (png.type() != CV_16UC1) throw std::runtime_error("its PNG is not 16-bit grey");
    return png;
  }
  constexpr std::size_t kSizes = 8;
  if (data.size() < kSizes) throw std::runtime_error("its message is too short");
  const auto columns = load_le<std::uint32_t>(&data[0]), rows = load_le<std::uint32_t>(&data[4]);
  check_image_size(columns, rows);
  cv::Mat1w depth(static_cast<int>(rows), static_cast<int>(columns));
  decode_rvl(data.subspan(kSizes), depth);
  return depth;
}

// An image behind a header of 12 bytes: format, and two floats with which depth in metres was made inverse.
void compressed_depth(const RosImage& image, double unit_mm, cv::Mat1f& depth_mm) {
  constexpr std::size_t kHeader = 12;
  if (image.data.size() < kHeader) throw std::runtime_error("its message is too short");
  const bool rvl = image.encoding.find("rvl") != std::string::npos;
  const cv::Mat1w stored = decode_compressed_depth(image.data.subspan(kHeader), rvl);
  if (!image.encoding.starts_with("32FC1")) return depth_from_units(stored, unit_mm, depth_mm);
  const auto a = load_le<float>(&image.data[4]), b = load_le<float>(&image.data[8]);
  cv::Mat1f metres(stored.size());
  std::transform(stored.begin(), stored.end(), metres.begin(), [&](std::uint16_t value) {
    return value == 0 ? 0.0F : a / (static_cast<float>(value) - b);
  });
  depth_from_reals(metres, 1000, depth_mm);
}

cv::Mat3b compressed_colour(const RosImage& image) {
  if (image.data.size() > 1 && image.data[0] == 0x89) {
    cv::Mat decoded = decode_png(image.data);
    if (decoded.depth() != CV_8U) throw std::runtime_error("its PNG is not of 8 bits");
    if (decoded.channels() == 1) cv::cvtColor(decoded, decoded, cv::COLOR_GRAY2BGR);
    return decoded;
  }
  const auto size = jpeg_size(image.data);
  if (!size) throw std::runtime_error("neither JPEG nor PNG");
  check_image_size(size->width, size->height);
  JpegCodec codec;
  cv::Mat3b decoded;
  if (const Outcome outcome = codec.decode(image.data, *size, decoded); !outcome)
    throw std::runtime_error(outcome.reason());
  return decoded;
}

struct ColourEncoding {
  string_view name;
  int type, conversion;  // conversion -1: it is BGR already
};
constexpr std::array<ColourEncoding, 7> kColours = {{{"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
                                                     {"bgr8", CV_8UC3, -1},
                                                     {"8UC3", CV_8UC3, -1},
                                                     {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
                                                     {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
                                                     {"mono8", CV_8UC1, cv::COLOR_GRAY2BGR},
                                                     {"8UC1", CV_8UC1, cv::COLOR_GRAY2BGR}}};

}  // namespace

bool RosImage::is_depth() const {
  if (compressed) return encoding.find("compressedDepth") != std::string::npos;
  return std::ranges::count(kDepth16, encoding) > 0 || encoding == "32FC1";
}

bool RosImage::is_colour() const {
  if (compressed) return !is_depth();
  return std::ranges::count(kColours, encoding, &ColourEncoding::name) > 0;
}

RosImage read_ros_image_header(Bytes message, const BagTopic& topic) {
  return read_image(MessageReader(message, topic.encoding), is_compressed(topic), false);
}

RosImage read_ros_image(Bytes message, const BagTopic& topic) {
  return read_image(MessageReader(message, topic.encoding), is_compressed(topic), true);
}

std::optional<Intrinsics> read_ros_camera(Bytes message, const BagTopic& topic) {
  MessageReader reader(message, topic.encoding);
  static_cast<void>(reader.stamp_ns());
  static_cast<void>(reader.number<std::uint32_t>());  // height, width
  static_cast<void>(reader.number<std::uint32_t>());
  static_cast<void>(reader.text());  // distortion model
  const auto distortions = reader.number<std::uint32_t>();
  constexpr std::uint32_t kMost = 64;
  if (distortions > kMost) throw std::runtime_error("too many numbers of distortion");
  for (std::uint32_t i = 0; i < distortions; ++i) static_cast<void>(reader.number<double>());
  std::array<double, 9> k{};
  for (double& value : k) value = reader.number<double>();
  const Intrinsics camera{k[0], k[4], k[2], k[5], IntrinsicsOrigin::file};
  return camera.valid() ? std::optional(camera) : std::nullopt;
}

void ros_depth(const RosImage& image, double unit_mm, cv::Mat1f& depth_mm) {
  if (!image.is_depth())
    throw std::runtime_error(fmt::format("{} is not depth", image.encoding.substr(0, 40)));
  if (image.compressed) return compressed_depth(image, unit_mm, depth_mm);
  if (image.encoding == "32FC1") {
    // Floats may lie anywhere in the message; a copy is aligned.
    const cv::Mat1f metres = pixels_of(image, CV_32FC1).clone();
    return depth_from_reals(metres, 1000, depth_mm);
  }
  const cv::Mat1w stored = pixels_of(image, CV_16UC1).clone();
  depth_from_units(stored, unit_mm, depth_mm);
}

cv::Mat3b ros_colour(const RosImage& image) {
  if (image.compressed) return compressed_colour(image);
  const auto encoding = std::ranges::find(kColours, image.encoding, &ColourEncoding::name);
  if (encoding == kColours.end())
    throw std::runtime_error(fmt::format("{} is not colour", image.encoding.substr(0, 40)));
  const cv::Mat pixels = pixels_of(image, encoding->type);
  cv::Mat3b colour;
  if (encoding->conversion < 0)
    pixels.copyTo(colour);
  else
    cv::cvtColor(pixels, colour, encoding->conversion);
  return colour;
}

}  // namespace saccade
