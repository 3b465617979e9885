#include "core/png.hpp"

#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <spng.h>
#include <opencv2/imgproc.hpp>

#include "core/image_size.hpp"

namespace saccade {
namespace {

using Context = std::unique_ptr<spng_ctx, void (*)(spng_ctx*)>;

void check(int code) {
  if (code != 0) throw std::runtime_error(fmt::format("not a valid PNG: {}", spng_strerror(code)));
}

Context open(std::span<const std::uint8_t> png, spng_ihdr& header) {
  if (png.empty()) throw std::runtime_error("empty file");
  Context context(spng_ctx_new(0), spng_ctx_free);
  if (!context) throw std::bad_alloc();
  check(spng_set_image_limits(context.get(), 1u << 30,
                              1u << 30));  // our own limit, below, has the clearer message
  check(spng_set_png_buffer(context.get(), png.data(), png.size()));
  check(spng_get_ihdr(context.get(), &header));
  check_image_size(header.width, header.height);
  return context;
}

bool is_grey_or_palette(const spng_ihdr& header) {
  return header.color_type == SPNG_COLOR_TYPE_GRAYSCALE || header.color_type == SPNG_COLOR_TYPE_INDEXED;
}

void decode_pixels(spng_ctx* context, cv::Mat& image, int format) {
  check(spng_decode_image(context, image.data, image.total() * image.elemSize(), format, 0));
  check(spng_decode_chunks(context));  // to the end, to detect a truncated file
}

// SPNG_FMT_PNG leaves samples below 8 bits packed. SPNG_FMT_G8 would widen grey samples, but scale them too,
// which is wrong for labels.
cv::Mat unpack(const cv::Mat1b& packed, cv::Size size, int bits) {
  cv::Mat1b image(size);
  const int per_byte = 8 / bits, mask = (1 << bits) - 1;
  for (int r = 0; r < size.height; ++r)
    for (int c = 0; c < size.width; ++c)
      image(r, c) =
          static_cast<std::uint8_t>(packed(r, c / per_byte) >> (8 - bits * (c % per_byte + 1)) & mask);
  return image;
}

}  // namespace

PngHeader read_png_header(std::span<const std::uint8_t> png) {
  spng_ihdr header{};
  open(png, header);
  const char* channels = "RGBA";
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      channels = "grey";
      break;
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      channels = "grey+alpha";
      break;
    case SPNG_COLOR_TYPE_TRUECOLOR:
      channels = "RGB";
      break;
    case SPNG_COLOR_TYPE_INDEXED:
      channels = "palette";
      break;
    default:
      break;
  }
  return {cv::Size(static_cast<int>(header.width), static_cast<int>(header.height)), header.bit_depth,
          channels};
}

cv::Mat decode_png(std::span<const std::uint8_t> png) {
  spng_ihdr header{};
  const Context context = open(png, header);
  const cv::Size size(static_cast<int>(header.width), static_cast<int>(header.height));
  const int bits = header.bit_depth;
  if (!is_grey_or_palette(header)) {
    cv::Mat image(size, CV_8UC3);
    decode_pixels(context.get(), image, SPNG_FMT_RGB8);
    cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
    return image;
  }
  const int row_bytes = bits >= 8 ? size.width : (size.width * bits + 7) / 8;
  cv::Mat image(size.height, row_bytes, bits == 16 ? CV_16UC1 : CV_8UC1);
  decode_pixels(context.get(), image, SPNG_FMT_PNG);
  return bits >= 8 ? image : unpack(image, size, bits);
}

}  // namespace saccade
