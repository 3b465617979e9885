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
    if (load_le<std::uint32_t>(bytes_.data()) == kZstd)
      throw std::runtime_error("its messages are compressed one by one, which ros2 bag convert undoes");
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

  template <std::size_t N>
  std::array<double, N> numbers() {
    std::array<double, N> values{};
    for (double& value : values) value = number<double>();
    return values;
  }

  std::int64_t stamp_ns() {
    if (!cdr_) static_cast<void>(number<std::uint32_t>());  // seq
    const auto seconds = number<std::uint32_t>();
    const auto nanoseconds = number<std::uint32_t>();
    static_cast<void>(text());  // frame_id
    return std::int64_t{seconds} * 1'000'000'000 + nanoseconds;
  }

 private:
  static constexpr std::uint32_t kZstd = 0xFD2FB528;  // the first bytes of its data

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

// The size of an uncompressed image, whose data hold its pixels.
cv::Size pixel_size(const RosImage& image, int type) {
  check_image_size(image.width, image.height);
  if (image.width == 0 || image.height == 0) throw std::runtime_error("an image without pixels");
  if (image.big_endian && CV_ELEM_SIZE1(type) > 1) throw std::runtime_error("its pixels are big-endian");
  const std::size_t row = std::size_t{image.width} * static_cast<std::size_t>(CV_ELEM_SIZE(type));
  if (image.step % static_cast<std::size_t>(CV_ELEM_SIZE1(type)) != 0)  // OpenCV has no such images
    throw std::runtime_error(fmt::format("a row of {} bytes ends within a number", image.step));
  if (image.step < row || image.data.size() / image.step < image.height)
    throw std::runtime_error(
        fmt::format("{} bytes are too few for {}x{} pixels", image.data.size(), image.width, image.height));
  return {static_cast<int>(image.width), static_cast<int>(image.height)};
}

// The pixels of an uncompressed image, in place.
cv::Mat pixels_of(const RosImage& image, int type) {
  return {pixel_size(image, type), type, const_cast<std::uint8_t*>(image.data.data()), image.step};
}

// Whether it is depth of the transport compressedDepth.
bool is_depth_transport(const RosImage& image) {
  return image.encoding.find("compressedDepth") != std::string::npos;
}

// A PNG of 16 bits ("16UC1; png compressed"), or depth of the transport compressedDepth: behind a header of
// 12 bytes (the format, and two floats with which depth in metres was made inverse) a PNG, or the size of the
// image (columns, rows: 32 bits each) and its pixels by RVL.
class CompressedDepth {
 public:
  explicit CompressedDepth(const RosImage& image)
      : inverse_(is_depth_transport(image) && image.encoding.starts_with("32FC1")),
        rvl_(is_depth_transport(image) && image.encoding.find("rvl") != std::string::npos) {
    const std::size_t header = is_depth_transport(image) ? kHeader : 0;
    if (image.data.size() < header + (rvl_ ? kSizes : 0))
      throw std::runtime_error("its message is too short");
    header_ = image.data.first(header);
    data_ = image.data.subspan(header);
  }

  cv::Size size() const {
    if (!rvl_) return read_png_header(data_).size;
    const auto columns = load_le<std::uint32_t>(&data_[0]), rows = load_le<std::uint32_t>(&data_[4]);
    check_image_size(columns, rows);
    return {static_cast<int>(columns), static_cast<int>(rows)};
  }

  void decode(double unit_mm, cv::Mat1f& depth_mm) const {
    const cv::Mat1w stored = decode_stored();
    if (!inverse_) return depth_from_units(stored, unit_mm > 0 ? unit_mm : 1, depth_mm);
    const auto a = load_le<float>(&header_[4]), b = load_le<float>(&header_[8]);
    cv::Mat1f reals(stored.size());
    std::transform(stored.begin(), stored.end(), reals.begin(), [&](std::uint16_t value) {
      return value == 0 ? 0.0F : a / (static_cast<float>(value) - b);
    });
    depth_from_reals(reals, unit_mm > 0 ? unit_mm : kMmPerMetre, depth_mm);
  }

 private:
  static constexpr std::size_t kHeader = 12, kSizes = 8;

  cv::Mat1w decode_stored() const {
    if (rvl_) {
      cv::Mat1w depth(size());
      decode_rvl(data_.subspan(kSizes), depth);
      return depth;
    }
    cv::Mat png = decode_png(data_);
    if (png.type() != CV_16UC1) throw std::runtime_error("its PNG is not 16-bit grey");
    return png;
  }

  bool inverse_, rvl_;
  Bytes header_, data_;
};

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

// k1, k2, p1, p2, k3 and, for rational_polynomial, k4, k5, k6: the order of LensCamera.
void read_distortion(MessageReader& reader, RosCamera& camera) {
  constexpr std::uint32_t kMost = 64;
  const auto count = reader.number<std::uint32_t>();
  if (count > kMost) throw std::runtime_error("too many numbers of distortion");
  camera.knows_distortion =
      camera.distortion_model == "plumb_bob" || camera.distortion_model == "rational_polynomial";
  auto& known = camera.lens.distortion;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto value = reader.number<double>();
    if (value == 0) continue;
    camera.distorted = true;
    if (i < known.size() && std::isfinite(value)) known[i] = value;
    if (i >= known.size() || !std::isfinite(value)) camera.knows_distortion = false;
  }
  if (!camera.knows_distortion) known = {};
}

}  // namespace

bool RosImage::is_depth() const {
  if (!compressed) return std::ranges::count(kDepth16, encoding) > 0 || encoding == "32FC1";
  const auto of_pixels = [&](string_view pixels) { return encoding.starts_with(pixels); };
  return is_depth_transport(*this) ||
         (std::ranges::any_of(kDepth16, of_pixels) && encoding.find("png") != std::string::npos);
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

Intrinsics scaled_camera(const Intrinsics& camera, double across, double down) {
  return {camera.fx * across, camera.fy * down, (camera.cx + 0.5) * across - 0.5,
          (camera.cy + 0.5) * down - 0.5, camera.origin};
}

std::optional<RosCamera> read_ros_camera(Bytes message, const BagTopic& topic) {
  MessageReader reader(message, topic.encoding);
  static_cast<void>(reader.stamp_ns());
  const auto height = reader.number<std::uint32_t>(), width = reader.number<std::uint32_t>();
  RosCamera camera;
  camera.distortion_model = reader.text();
  read_distortion(reader, camera);
  const auto k = reader.numbers<9>();
  static_cast<void>(reader.numbers<9>());  // R: of stereo cameras
  const auto p = reader.numbers<12>();
  camera.lens.pinhole = {k[0], k[4], k[2], k[5], IntrinsicsOrigin::file};
  if (!camera.lens.pinhole.valid()) return std::nullopt;
  camera.rectified = {p[0], p[5], p[2], p[6], IntrinsicsOrigin::file};
  const auto binning_x = std::max(reader.number<std::uint32_t>(), 1U),
             binning_y = std::max(reader.number<std::uint32_t>(), 1U);
  const auto left = reader.number<std::uint32_t>(), top = reader.number<std::uint32_t>(),
             rows = reader.number<std::uint32_t>(), columns = reader.number<std::uint32_t>();
  // Of the sensor, the numbers become those of its part (0 x 0: all of it), in which some pixels are one.
  for (Intrinsics* each : {&camera.lens.pinhole, &camera.rectified})
    *each = scaled_camera({each->fx, each->fy, each->cx - left, each->cy - top, each->origin},
                          1.0 / binning_x, 1.0 / binning_y);
  const auto side = [](std::uint32_t whole, std::uint32_t part, std::uint32_t binning) {
    return static_cast<int>(std::min((part > 0 ? part : whole) / binning, 1U << 20));
  };
  camera.lens.size = {side(width, columns, binning_x), side(height, rows, binning_y)};
  return camera;
}

cv::Size ros_depth_size(const RosImage& image) {
  if (!image.is_depth())
    throw std::runtime_error(fmt::format("{} is not depth", image.encoding.substr(0, 40)));
  if (image.compressed) return CompressedDepth(image).size();
  return pixel_size(image, image.encoding == "32FC1" ? CV_32FC1 : CV_16UC1);
}

void ros_depth(const RosImage& image, double unit_mm, cv::Mat1f& depth_mm) {
  static_cast<void>(ros_depth_size(image));
  if (image.compressed) return CompressedDepth(image).decode(unit_mm, depth_mm);
  if (image.encoding == "32FC1") {
    // Floats may lie anywhere in the message; a copy is aligned.
    const cv::Mat1f reals = pixels_of(image, CV_32FC1).clone();
    return depth_from_reals(reals, unit_mm > 0 ? unit_mm : kMmPerMetre, depth_mm);
  }
  const cv::Mat1w stored = pixels_of(image, CV_16UC1).clone();
  depth_from_units(stored, unit_mm > 0 ? unit_mm : 1, depth_mm);
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
