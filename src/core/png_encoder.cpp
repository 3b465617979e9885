#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include <libdeflate.h>
#include <opencv2/imgproc.hpp>

#include "core/png.hpp"

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Of 1..12, the fastest: the next two take a fifth longer each and save 2 % of an overlay.
constexpr int kLevel = 1;

void append_big_endian(Bytes& out, std::size_t value) {
  for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_chunk(Bytes& out, const char (&type)[5], std::span<const std::uint8_t> data) {
  append_big_endian(out, data.size());
  const std::size_t begin = out.size();
  out.insert(out.end(), type, type + 4);
  out.insert(out.end(), data.begin(), data.end());
  append_big_endian(out, libdeflate_crc32(0, out.data() + begin, out.size() - begin));
}

// The samples of a row in the file's order: RGB, or big-endian.
void store_row(const cv::Mat& image, int row, std::uint8_t* to) {
  if (image.type() == CV_8UC3) {
    cv::Mat rgb(1, image.cols, CV_8UC3, to);
    cv::cvtColor(image.row(row), rgb, cv::COLOR_BGR2RGB);
  } else if (image.type() == CV_16UC1) {
    for (int c = 0; c < image.cols; ++c) {
      const unsigned value = image.at<std::uint16_t>(row, c);
      to[2 * c] = static_cast<std::uint8_t>(value >> 8);
      to[2 * c + 1] = static_cast<std::uint8_t>(value);
    }
  } else {
    std::memcpy(to, image.ptr(row), static_cast<std::size_t>(image.cols));
  }
}

// All rows, each after the number of its filter: Up, the difference to the row above.
Bytes filtered_rows(const cv::Mat& image) {
  constexpr std::uint8_t kUp = 2;
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  Bytes above(row_bytes), row(row_bytes), out((row_bytes + 1) * static_cast<std::size_t>(image.rows));
  std::uint8_t* to = out.data();
  for (int r = 0; r < image.rows; ++r) {
    store_row(image, r, row.data());
    *to++ = kUp;
    for (std::size_t i = 0; i < row_bytes; ++i) to[i] = static_cast<std::uint8_t>(row[i] - above[i]);
    to += row_bytes;
    std::swap(row, above);
  }
  return out;
}

Bytes compress(const Bytes& data) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  Bytes out(libdeflate_zlib_compress_bound(compressor.get(), data.size()));
  out.resize(libdeflate_zlib_compress(compressor.get(), data.data(), data.size(), out.data(), out.size()));
  return out;
}

}  // namespace

// The chunks are written here and not by libspng, which knows only zlib: libdeflate takes half of its time.
std::vector<std::uint8_t> encode_png(const cv::Mat& image) {
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_16UC1 && image.type() != CV_8UC3))
    throw std::invalid_argument("encode_png: 8-bit grey, 16-bit grey or 8-bit BGR expected");
  Bytes header;
  append_big_endian(header, static_cast<std::size_t>(image.cols));
  append_big_endian(header, static_cast<std::size_t>(image.rows));
  const bool is_colour = image.channels() == 3;
  // Depth, colour type (2 = RGB, 0 = grey), compression, filter method, no interlacing.
  for (const int value : {image.depth() == CV_16U ? 16 : 8, is_colour ? 2 : 0, 0, 0, 0})
    header.push_back(static_cast<std::uint8_t>(value));
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  const Bytes pixels = compress(filtered_rows(image));
  out.reserve(pixels.size() + 64);
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", pixels);
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace saccade
