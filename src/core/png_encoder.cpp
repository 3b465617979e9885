#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <libdeflate.h>
#include <opencv2/imgproc.hpp>

#include "core/png.hpp"
#include "core/run_deflater.hpp"

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kSub = 1, kUp = 2;  // filters, as the format numbers them

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

// The differences of a row to the one above (Up), or of its samples to those on their left (Sub).
void filter_row(const Bytes& row, const Bytes& above, int filter, std::size_t pixel_bytes, std::uint8_t* to) {
  if (filter == kUp) {
    for (std::size_t i = 0; i < row.size(); ++i) to[i] = static_cast<std::uint8_t>(row[i] - above[i]);
    return;
  }
  std::copy_n(row.begin(), pixel_bytes, to);
  for (std::size_t i = pixel_bytes; i < row.size(); ++i)
    to[i] = static_cast<std::uint8_t>(row[i] - row[i - pixel_bytes]);
}

// All rows, each after the number of its filter. Depth is smooth along a row and pictures in both directions:
// measured, these filters give the smaller files.
Bytes compress_rows(const cv::Mat& image) {
  constexpr std::size_t kBlockBytes = 1 << 16;
  const int filter = image.depth() == CV_16U ? kSub : kUp;
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  const int block_rows = static_cast<int>(std::max<std::size_t>(1, kBlockBytes / (row_bytes + 1)));
  Bytes above(row_bytes), row(row_bytes), block;
  RunDeflater deflater;
  for (int first = 0; first < image.rows; first += block_rows) {
    const int end = std::min(first + block_rows, image.rows);
    block.resize((row_bytes + 1) * static_cast<std::size_t>(end - first));
    std::uint8_t* to = block.data();
    for (int r = first; r < end; ++r) {
      store_row(image, r, row.data());
      *to++ = static_cast<std::uint8_t>(filter);
      filter_row(row, above, filter, image.elemSize(), to);
      to += row_bytes;
      std::swap(row, above);
    }
    deflater.add(block);
  }
  return deflater.finish();
}

}  // namespace

// Not by libspng, which knows only zlib: a search for repetitions finds none in the noise of pictures and
// takes five times as long.
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
  const Bytes pixels = compress_rows(image);
  out.reserve(pixels.size() + 64);
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", pixels);
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace saccade
