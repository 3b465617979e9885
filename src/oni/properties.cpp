#include "oni/properties.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "oni/bytes.hpp"
#include "oni/index.hpp"

namespace saccade {
namespace {

constexpr OniPropertySize exactly(std::size_t size) { return {size, size, 1}; }

OniPixelFormat default_format(OniNodeType type) {
  switch (type) {
    case OniNodeType::depth:
      return OniPixelFormat::depth_1mm;
    case OniNodeType::ir:
      return OniPixelFormat::grey16;
    default:
      return OniPixelFormat::rgb888;
  }
}

// The pixel format of the two properties; absent if they name none that fits the node.
std::optional<OniPixelFormat> pixel_format(const OniNode& node, std::uint64_t position) {
  const bool depth = node.declared.type == OniNodeType::depth;
  if (const auto number = node.int_property(oni_property::kOniFormat, position)) {
    const auto format = pixel_format_of(*number);
    return format && holds_depth(*format) == depth ? format : std::nullopt;
  }
  const auto number = node.int_property(oni_property::kXnFormat, position);
  if (!number) return default_format(node.declared.type);
  if (depth) return *number == 4 ? std::optional(OniPixelFormat::depth_1mm) : std::nullopt;
  // 1..5 are RGB24, YUV422, grey 8, grey 16 and JPEG, in the order of OpenNI2's numbers.
  if (*number < 1 || *number > 5) return std::nullopt;
  return pixel_format_of(199 + *number);
}

bool fits(OniCodec codec, OniPixelFormat format) {
  switch (codec) {
    case OniCodec::none:
      return true;
    case OniCodec::z16t:
    case OniCodec::z16p:
      return bytes_per_pixel(format) == 2;
    case OniCodec::z8:
      return format != OniPixelFormat::jpeg && !holds_depth(format);
    case OniCodec::jpeg:
      return format == OniPixelFormat::rgb888 || format == OniPixelFormat::grey8;
  }
  return false;
}

bool is_angle(double value) { return std::isfinite(value) && value > 0 && value < std::numbers::pi; }

std::optional<Intrinsics> from_angles(double horizontal_rad, double vertical_rad, cv::Size size) {
  if (!is_angle(horizontal_rad) || !is_angle(vertical_rad)) return std::nullopt;
  const auto camera =
      Intrinsics::from_field_of_view(size, horizontal_rad, vertical_rad, IntrinsicsOrigin::file);
  return camera.valid() ? std::optional(camera) : std::nullopt;
}

// The crop, or the full image if there is none or it does not fit.
cv::Rect crop_at(const OniNode& node, std::uint64_t position, cv::Size size) {
  const auto crop = cropping_at(node, position);
  return crop && fits_in(*crop, size) ? *crop : cv::Rect(cv::Point(0, 0), size);
}

}  // namespace

std::optional<cv::Rect> cropping_at(const OniNode& node, std::uint64_t position) {
  const auto value = node.property(oni_property::kCropping, position);
  if (!value || load_le<std::uint32_t>(value->data()) == 0) return std::nullopt;
  const auto number = [&](std::size_t i) { return int{load_le<std::uint16_t>(value->data() + 4 + 2 * i)}; };
  return cv::Rect(number(0), number(1), number(2), number(3));
}

bool fits_in(const cv::Rect& part, cv::Size size) {
  return part.width >= 1 && part.height >= 1 && part.x + part.width <= size.width &&
         part.y + part.height <= size.height;
}

std::optional<OniPropertySize> known_property_size(std::string_view name) {
  using namespace oni_property;
  static constexpr std::array<std::pair<std::string_view, OniPropertySize>, 15> kKnown = {{
      {kMode, exactly(12)},
      {kXnFormat, exactly(8)},
      {kOniFormat, exactly(8)},
      {kMaxDepth, exactly(8)},
      {kFov, exactly(16)},
      {kRealWorld, exactly(24)},
      {kCropping, exactly(12)},
      {kMirror, exactly(8)},
      {kShiftToDepth, {2, kOniMaxPropertySize, 2}},
      {kIntrinsics, exactly(32)},
      {kIntrinsicsGuessed, exactly(8)},
      {kRegistered, exactly(8)},
      {kDropped, exactly(8)},
      {kRounded, exactly(8)},
      {kWrittenBy, {1, kOniMaxName, 1}},
  }};
  const auto found =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const auto& k) { return k.first == name; });
  return found == kKnown.end() ? std::nullopt : std::optional(found->second);
}

OniFormat format_at(const OniNode& node, std::uint64_t position) {
  OniFormat format;
  const auto fail = [&](std::string why) {
    format.unusable = std::move(why);
    return format;
  };
  if (!is_known(node.declared.codec))
    return fail(fmt::format("unknown codec {}", to_string(node.declared.codec)));
  const auto mode = node.property(oni_property::kMode, position);
  if (!mode) return fail("no image size");
  const auto width = load_le<std::uint32_t>(mode->data()), height = load_le<std::uint32_t>(mode->data() + 4),
             rate = load_le<std::uint32_t>(mode->data() + 8);
  if (width < 1 || height < 1 || width > kOniMaxSide || height > kOniMaxSide ||
      std::uint64_t{width} * height > kOniMaxPixels)
    return fail(fmt::format("impossible image size {} x {}", width, height));
  format.size = {static_cast<int>(width), static_cast<int>(height)};
  format.crop = crop_at(node, position, format.size);
  const auto whole = static_cast<std::uint64_t>(format.size.area()),
             part = static_cast<std::uint64_t>(format.crop.area());
  if (whole > kOniFreeCropPixels && whole / kOniMaxCropRatio > part)
    return fail(fmt::format("frames of {} x {} in an image of {} x {}", format.crop.width, format.crop.height,
                            width, height));
  if (rate >= 1 && rate <= 1000) format.rate_hz = rate;
  const auto pixels = pixel_format(node, position);
  if (!pixels) return fail(fmt::format("impossible pixel format for {}", to_string(node.declared.type)));
  format.pixels = *pixels;
  if (!fits(node.declared.codec, *pixels))
    return fail(fmt::format("codec {} cannot hold {}", to_string(node.declared.codec), to_string(*pixels)));
  if ((*pixels == OniPixelFormat::yuv422 || *pixels == OniPixelFormat::yuyv) && format.crop.width % 2 != 0)
    return fail("colour pairs in an image of odd width");
  const bool shifts = *pixels == OniPixelFormat::shift_9_2 || *pixels == OniPixelFormat::shift_9_3;
  if (shifts && !node.property(oni_property::kShiftToDepth, position))
    return fail("raw shifts without their table S2D");
  return format;
}

std::optional<Intrinsics> intrinsics_at(const OniNode& node, std::uint64_t position, cv::Size size) {
  if (const auto value = node.property(oni_property::kIntrinsics, position)) {
    const auto number = [&](std::size_t i) { return load_le<double>(value->data() + 8 * i); };
    const bool guessed = node.int_property(oni_property::kIntrinsicsGuessed, position).value_or(0) != 0;
    const Intrinsics camera{number(0), number(1), number(2), number(3),
                            guessed ? IntrinsicsOrigin::guess : IntrinsicsOrigin::file};
    if (camera.valid()) return camera;
  }
  if (const auto value = node.property(oni_property::kFov, position)) {
    const auto camera = from_angles(load_le<double>(value->data()), load_le<double>(value->data() + 8), size);
    if (camera) return camera;
  }
  if (const auto value = node.property(oni_property::kRealWorld, position)) {
    const auto number = [&](std::size_t i) { return load_le<double>(value->data() + 8 * i); };
    const double plane = number(0), pixel = number(1), ratio = number(2);
    return from_angles(2 * std::atan(pixel * ratio * size.width / 2 / plane),
                       2 * std::atan(pixel * ratio * size.height / 2 / plane), size);
  }
  return std::nullopt;
}

}  // namespace saccade
