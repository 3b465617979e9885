#include "oni/image_decoder.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "oni/bytes.hpp"
#include "oni/codec_im8z.hpp"

namespace saccade {
namespace {

constexpr const char* kTooShort = "the coded data is too short for the image";

std::string wrong_size(std::size_t is, std::size_t should) {
  return fmt::format("decoded to {} bytes instead of {}", is, should);
}

// The image from which the packed pixels of one frame are shown; nothing is copied.
template <typename T>
cv::Mat packed(std::vector<std::uint8_t>& bytes, cv::Size size) {
  return cv::Mat(size, cv::traits::Type<T>::value, bytes.data());
}

void gray16_to_bgr(const cv::Mat& gray, cv::Mat3b& image) {
  cv::Mat1b eight;
  gray.convertTo(eight, CV_8U, 255.0 / 1023.0);
  cv::cvtColor(eight, image, cv::COLOR_GRAY2BGR);
}

}  // namespace

std::string OniImageDecoder::decode_16z(Codec16z codec, const OniFormat& format,
                                        std::span<const std::uint8_t> payload) {
  const auto area = static_cast<std::size_t>(format.size.area()),
             crop_area = static_cast<std::size_t>(format.crop.area());
  if (!may_hold_16z(payload.size(), crop_area)) return kTooShort;
  // Room for the full image: a recorder does not tell when cropping is switched off during a recording.
  const std::size_t room = may_hold_16z(payload.size(), area) ? area : crop_area;
  if (pixels_.size() < 2 * room) pixels_.resize(2 * room);
  const std::span out(reinterpret_cast<std::uint16_t*>(pixels_.data()), room);
  const Decoded16z decoded = decoder_16z_.decode(codec, payload, out);
  if (decoded.fault != nullptr) return decoded.fault;
  if (decoded.pixels != crop_area && decoded.pixels != area)
    return wrong_size(2 * decoded.pixels, 2 * crop_area);
  place_ = decoded.pixels == crop_area ? format.crop : cv::Rect(cv::Point(0, 0), format.size);
  return {};
}

// The usual case, a frame that is not cropped, without a copy in between.
std::string OniImageDecoder::decode_whole_16z(Codec16z codec, cv::Size size,
                                              std::span<const std::uint8_t> payload, cv::Mat1w& depth) {
  const auto area = static_cast<std::size_t>(size.area());
  if (!may_hold_16z(payload.size(), area)) return kTooShort;
  depth.create(size);
  if (!depth.isContinuous()) depth = cv::Mat1w(size);
  const Decoded16z decoded = decoder_16z_.decode(codec, payload, {depth.ptr<std::uint16_t>(), area});
  if (decoded.fault != nullptr) return decoded.fault;
  return decoded.pixels == area ? std::string() : wrong_size(2 * decoded.pixels, 2 * area);
}

// The packed pixels of a frame into pixels_, and where they belong into place_.
std::string OniImageDecoder::decode_pixels(OniCodec codec, const OniFormat& format,
                                           std::span<const std::uint8_t> payload) {
  if (codec == OniCodec::z16t) return decode_16z(Codec16z::table, format, payload);
  if (codec == OniCodec::z16p) return decode_16z(Codec16z::plain, format, payload);
  const std::size_t depth = bytes_per_pixel(format.pixels),
                    full = static_cast<std::size_t>(format.size.area()) * depth,
                    crop = static_cast<std::size_t>(format.crop.area()) * depth;
  place_ = format.crop;
  if (codec == OniCodec::z8) {
    if (!may_hold_im8z(payload.size(), crop)) return kTooShort;
    if (pixels_.size() < crop) pixels_.resize(crop);
    const DecodedIm8z decoded = decode_im8z(payload, std::span(pixels_).first(crop));
    if (decoded.fault != nullptr) return decoded.fault;
    return decoded.bytes == crop ? std::string() : wrong_size(decoded.bytes, crop);
  }
  if (payload.size() != crop && payload.size() != full) return wrong_size(payload.size(), crop);
  if (payload.size() != crop) place_ = cv::Rect(cv::Point(0, 0), format.size);
  if (pixels_.size() < payload.size()) pixels_.resize(payload.size());
  std::memcpy(pixels_.data(), payload.data(), payload.size());
  return {};
}

std::string OniImageDecoder::decode_depth(OniCodec codec, const OniFormat& format,
                                          std::span<const std::uint8_t> payload, cv::Mat1w& depth) {
  if (!format.unusable.empty()) return format.unusable;
  const bool z16 = codec == OniCodec::z16t || codec == OniCodec::z16p;
  if (z16 && format.crop.size() == format.size)
    return decode_whole_16z(codec == OniCodec::z16t ? Codec16z::table : Codec16z::plain, format.size, payload,
                            depth);
  const std::string fault = decode_pixels(codec, format, payload);
  if (!fault.empty()) return fault;
  depth.create(format.size);
  if (place_.size() != format.size) depth.setTo(0);
  packed<std::uint16_t>(pixels_, place_.size()).copyTo(depth(place_));
  return {};
}

std::string OniImageDecoder::decode_colour(OniCodec codec, const OniFormat& format,
                                           std::span<const std::uint8_t> payload, cv::Mat3b& image) {
  if (!format.unusable.empty()) return format.unusable;
  cv::Mat3b& target = format.crop.size() == format.size ? image : part_;
  if (codec == OniCodec::jpeg || format.pixels == OniPixelFormat::jpeg) {
    place_ = format.crop;
    const std::string fault = jpeg_.decode(payload, place_.size(), target);
    if (!fault.empty()) return fault;
  } else {
    const std::string fault = decode_pixels(codec, format, payload);
    if (!fault.empty()) return fault;
    const cv::Size size = place_.size();
    switch (format.pixels) {
      case OniPixelFormat::rgb888:
        cv::cvtColor(packed<cv::Vec3b>(pixels_, size), target, cv::COLOR_RGB2BGR);
        break;
      case OniPixelFormat::yuv422:
        cv::cvtColor(packed<cv::Vec2b>(pixels_, size), target, cv::COLOR_YUV2BGR_UYVY);
        break;
      case OniPixelFormat::yuyv:
        cv::cvtColor(packed<cv::Vec2b>(pixels_, size), target, cv::COLOR_YUV2BGR_YUY2);
        break;
      case OniPixelFormat::gray8:
        cv::cvtColor(packed<std::uint8_t>(pixels_, size), target, cv::COLOR_GRAY2BGR);
        break;
      default:
        gray16_to_bgr(packed<std::uint16_t>(pixels_, size), target);
    }
  }
  if (&target == &part_) {
    image.create(format.size);
    image.setTo(cv::Scalar::all(0));
    part_.copyTo(image(place_));
  }
  return {};
}

void depth_to_mm(const cv::Mat1w& stored, OniPixelFormat format,
                 std::optional<std::span<const std::uint8_t>> shift_to_depth_mm, cv::Mat1f& depth_mm) {
  depth_mm.create(stored.size());
  const bool shifts = format == OniPixelFormat::shift_9_2 || format == OniPixelFormat::shift_9_3;
  const auto table = shift_to_depth_mm.value_or(std::span<const std::uint8_t>());
  for (int row = 0; row < stored.rows; ++row) {
    const std::uint16_t* in = stored[row];
    float* out = depth_mm[row];
    if (shifts) {
      for (int col = 0; col < stored.cols; ++col) {
        const std::size_t at = std::size_t{2} * in[col];
        out[col] = at + 2 <= table.size() ? static_cast<float>(load_le<std::uint16_t>(&table[at])) : 0.0f;
      }
    } else if (format == OniPixelFormat::depth_100um) {
      for (int col = 0; col < stored.cols; ++col) out[col] = static_cast<float>(in[col]) / 10.0f;
    } else {
      for (int col = 0; col < stored.cols; ++col) out[col] = static_cast<float>(in[col]);
    }
  }
}

}  // namespace saccade
