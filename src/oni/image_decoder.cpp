#include "oni/image_decoder.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/depth_units.hpp"
#include "oni/bytes.hpp"
#include "oni/codec_im8z.hpp"

namespace saccade {
namespace {

constexpr const char* kTooShort = "the coded data is too short for the image";

Outcome wrong_size(std::size_t actual, std::size_t expected) {
  return Outcome::failure(fmt::format("decoded to {} bytes instead of {}", actual, expected));
}

// An image that shares the memory of the packed pixels.
template <typename T>
cv::Mat packed(std::vector<std::uint8_t>& bytes, cv::Size size) {
  return cv::Mat(size, cv::traits::Type<T>::value, bytes.data());
}

cv::Rect whole(cv::Size size) { return {cv::Point(0, 0), size}; }

void grey16_to_bgr(const cv::Mat& grey, cv::Mat3b& image) {
  cv::Mat1b eight;
  grey.convertTo(eight, CV_8U, 255.0 / 1023.0);
  cv::cvtColor(eight, image, cv::COLOR_GRAY2BGR);
}

// The packed pixels of any format that is not JPEG (README 3.1).
void to_bgr(OniPixelFormat format, std::vector<std::uint8_t>& pixels, cv::Size size, cv::Mat3b& image) {
  switch (format) {
    case OniPixelFormat::rgb888:
      return cv::cvtColor(packed<cv::Vec3b>(pixels, size), image, cv::COLOR_RGB2BGR);
    case OniPixelFormat::yuv422:
      return cv::cvtColor(packed<cv::Vec2b>(pixels, size), image, cv::COLOR_YUV2BGR_UYVY);
    case OniPixelFormat::yuyv:
      return cv::cvtColor(packed<cv::Vec2b>(pixels, size), image, cv::COLOR_YUV2BGR_YUY2);
    case OniPixelFormat::grey8:
      return cv::cvtColor(packed<std::uint8_t>(pixels, size), image, cv::COLOR_GRAY2BGR);
    default:
      return grey16_to_bgr(packed<std::uint16_t>(pixels, size), image);
  }
}

}  // namespace

Outcome OniImageDecoder::decode_16z(Codec16z codec, const OniFormat& format,
                                    std::span<const std::uint8_t> payload) {
  const auto area = static_cast<std::size_t>(format.size.area()),
             crop_area = static_cast<std::size_t>(format.crop.area());
  if (!may_hold_16z(payload.size(), crop_area)) return Outcome::failure(kTooShort);
  // Room for the full image: recorders write no record when cropping is switched off (README 3.2).
  const std::size_t room = may_hold_16z(payload.size(), area) ? area : crop_area;
  if (pixels_.size() < 2 * room) pixels_.resize(2 * room);
  const std::span out(reinterpret_cast<std::uint16_t*>(pixels_.data()), room);
  const Decoded16z decoded = decoder_16z_.decode(codec, payload, out);
  if (decoded.fault != nullptr) return Outcome::failure(decoded.fault);
  if (decoded.pixels != crop_area && decoded.pixels != area)
    return wrong_size(2 * decoded.pixels, 2 * crop_area);
  place_ = decoded.pixels == crop_area ? format.crop : whole(format.size);
  return Outcome::success();
}

// The usual case, a frame that is not cropped, without an intermediate copy.
Outcome OniImageDecoder::decode_full_16z(Codec16z codec, cv::Size size, std::span<const std::uint8_t> payload,
                                         cv::Mat1w& depth) {
  const auto area = static_cast<std::size_t>(size.area());
  if (!may_hold_16z(payload.size(), area)) return Outcome::failure(kTooShort);
  depth.create(size);
  if (!depth.isContinuous()) depth = cv::Mat1w(size);
  const Decoded16z decoded = decoder_16z_.decode(codec, payload, {depth.ptr<std::uint16_t>(), area});
  if (decoded.fault != nullptr) return Outcome::failure(decoded.fault);
  return decoded.pixels == area ? Outcome::success() : wrong_size(2 * decoded.pixels, 2 * area);
}

// Decodes the packed pixels of a frame into pixels_, and sets place_ to their rectangle in the image.
Outcome OniImageDecoder::decode_pixels(OniCodec codec, const OniFormat& format,
                                       std::span<const std::uint8_t> payload) {
  if (codec == OniCodec::z16t) return decode_16z(Codec16z::table, format, payload);
  if (codec == OniCodec::z16p) return decode_16z(Codec16z::plain, format, payload);
  const std::size_t pixel_size = bytes_per_pixel(format.pixels),
                    full = static_cast<std::size_t>(format.size.area()) * pixel_size,
                    crop = static_cast<std::size_t>(format.crop.area()) * pixel_size;
  place_ = format.crop;
  if (codec == OniCodec::z8) {
    if (!may_hold_im8z(payload.size(), crop)) return Outcome::failure(kTooShort);
    if (pixels_.size() < crop) pixels_.resize(crop);
    const DecodedIm8z decoded = decode_im8z(payload, std::span(pixels_).first(crop));
    if (decoded.fault != nullptr) return Outcome::failure(decoded.fault);
    return decoded.bytes == crop ? Outcome::success() : wrong_size(decoded.bytes, crop);
  }
  if (payload.size() != crop && payload.size() != full) return wrong_size(payload.size(), crop);
  if (payload.size() != crop) place_ = whole(format.size);
  if (pixels_.size() < payload.size()) pixels_.resize(payload.size());
  std::memcpy(pixels_.data(), payload.data(), payload.size());
  return Outcome::success();
}

Outcome OniImageDecoder::decode_depth(OniCodec codec, const OniFormat& format,
                                      std::span<const std::uint8_t> payload, cv::Mat1w& depth) {
  if (format.unusable) return Outcome::failure(*format.unusable);
  const bool z16 = codec == OniCodec::z16t || codec == OniCodec::z16p;
  if (z16 && format.crop.size() == format.size)
    return decode_full_16z(codec == OniCodec::z16t ? Codec16z::table : Codec16z::plain, format.size, payload,
                           depth);
  if (Outcome decoded = decode_pixels(codec, format, payload); !decoded) return decoded;
  depth.create(format.size);
  if (place_.size() != format.size) depth.setTo(0);
  packed<std::uint16_t>(pixels_, place_.size()).copyTo(depth(place_));
  return Outcome::success();
}

// The image in place_, of its size.
Outcome OniImageDecoder::decode_colour_part(OniCodec codec, const OniFormat& format,
                                            std::span<const std::uint8_t> payload, cv::Mat3b& part) {
  if (codec == OniCodec::jpeg || format.pixels == OniPixelFormat::jpeg) {
    place_ = format.crop;
    return jpeg_.decode(payload, place_.size(), part);
  }
  if (Outcome decoded = decode_pixels(codec, format, payload); !decoded) return decoded;
  to_bgr(format.pixels, pixels_, place_.size(), part);
  return Outcome::success();
}

Outcome OniImageDecoder::decode_colour(OniCodec codec, const OniFormat& format,
                                       std::span<const std::uint8_t> payload, cv::Mat3b& image) {
  if (format.unusable) return Outcome::failure(*format.unusable);
  if (format.crop.size() == format.size) return decode_colour_part(codec, format, payload, image);
  if (Outcome decoded = decode_colour_part(codec, format, payload, part_); !decoded) return decoded;
  image.create(format.size);
  image.setTo(cv::Scalar::all(0));
  part_.copyTo(image(place_));
  return Outcome::success();
}

void depth_to_mm(const cv::Mat1w& stored, OniPixelFormat format,
                 std::optional<std::span<const std::uint8_t>> shift_to_depth_mm, cv::Mat1f& depth_mm) {
  if (format != OniPixelFormat::shift_9_2 && format != OniPixelFormat::shift_9_3)
    return depth_from_units(stored, format == OniPixelFormat::depth_100um ? 0.1 : 1, depth_mm);
  const auto table = shift_to_depth_mm.value_or(std::span<const std::uint8_t>());
  cv::Mat1w entries(stored.size());
  std::transform(stored.begin(), stored.end(), entries.begin(), [&](std::uint16_t shift) -> std::uint16_t {
    const std::size_t at = std::size_t{2} * shift;
    return at + 2 <= table.size() ? load_le<std::uint16_t>(&table[at]) : std::uint16_t{0};
  });
  depth_from_units(entries, 1, depth_mm);
}

}  // namespace saccade
