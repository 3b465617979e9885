#include "output/tiff.hpp"

#include <bit>
#include <stdexcept>
#include <utility>

namespace saccade {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are copied as they are in memory");

constexpr int kShort = 3, kLong = 4;  // types of a field, as the format numbers them

class Writer {
 public:
  void put(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void put_field(int tag, int type, std::uint32_t count, std::uint32_t value) {
    put(static_cast<std::uint32_t>(tag), 2);
    put(static_cast<std::uint32_t>(type), 2);
    put(count, 4);
    put(value, 4);
  }
  void put_row(const cv::Mat& image, int row) {
    const std::uint8_t* samples = image.ptr(row);
    bytes_.insert(bytes_.end(), samples, samples + static_cast<std::size_t>(image.cols) * image.elemSize());
  }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

// Not by OpenCV: its encoder ends the program where memory runs out while it closes a file.
std::vector<std::uint8_t> encode_tiff(const cv::Mat& image) {
  if (image.empty() || (image.type() != CV_32FC1 && image.type() != CV_32FC3))
    throw std::invalid_argument("encode_tiff: an image of 32-bit floats with 1 or 3 channels expected");
  constexpr std::uint32_t kFields = 10, kHeaderBytes = 8, kLists = kHeaderBytes + 2 + 12 * kFields + 4;
  constexpr std::uint32_t kListBytes = 3 * 2, kPixels = kLists + 2 * kListBytes;
  const auto channels = static_cast<std::uint32_t>(image.channels());
  const auto width = static_cast<std::uint32_t>(image.cols), height = static_cast<std::uint32_t>(image.rows);
  const std::uint32_t pixel_bytes = width * height * 4 * channels;
  // A field holds a value of at most 4 bytes itself, else the place of its list.
  const bool is_colour = channels == 3;
  const std::uint32_t bits = is_colour ? kLists : 32, formats = is_colour ? kLists + kListBytes : 3;

  Writer out;
  out.reserve(kPixels + pixel_bytes);
  out.put('I' | 'I' << 8 | 42 << 16, 4);
  out.put(kHeaderBytes, 4);
  out.put(kFields, 2);
  out.put_field(256, kLong, 1, width);
  out.put_field(257, kLong, 1, height);
  out.put_field(258, kShort, channels, bits);        // bits per sample
  out.put_field(259, kShort, 1, 1);                  // no compression
  out.put_field(262, kShort, 1, is_colour ? 2 : 1);  // RGB, or grey with 0 = black
  out.put_field(273, kLong, 1, kPixels);             // place of the strip
  out.put_field(277, kShort, 1, channels);           // samples per pixel
  out.put_field(278, kLong, 1, height);              // rows of the strip
  out.put_field(279, kLong, 1, pixel_bytes);         // its bytes
  out.put_field(339, kShort, channels, formats);     // sample format: 3 = float
  out.put(0, 4);                                     // no other image
  for (int i = 0; i < 3; ++i) out.put(32, 2);
  for (int i = 0; i < 3; ++i) out.put(3, 2);
  for (int row = 0; row < image.rows; ++row) out.put_row(image, row);
  return out.take();
}

}  // namespace saccade
