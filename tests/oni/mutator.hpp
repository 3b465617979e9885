#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "oni/bytes.hpp"
#include "oni_fixtures.hpp"

namespace saccade {

/// Small recordings of every kind of stream that the reader knows, made by our own writer.
inline std::vector<std::vector<std::uint8_t>> seed_recordings(const std::filesystem::path& folder) {
  std::vector<std::vector<std::uint8_t>> seeds;
  const auto file = folder / "seed.oni";
  const cv::Size size(16, 12);
  for (const OniDepthCodec depth : {OniDepthCodec::z16t, OniDepthCodec::z16p, OniDepthCodec::none})
    for (const OniColourCodec colour : {OniColourCodec::jpeg, OniColourCodec::none}) {
      record_test_frames(file, 4, size, true,
                         {.depth_codec = depth, .colour_codec = colour, .overwrite = true});
      seeds.push_back(read_bytes(file));
    }
  // A cropped stream of shifts, and pictures of the other formats.
  for (const OniPixelFormat pixels :
       {OniPixelFormat::yuv422, OniPixelFormat::yuyv, OniPixelFormat::grey8, OniPixelFormat::grey16}) {
    OniRecordWriter writer(file, true);
    add_test_stream(writer, 1, {.pixels = OniPixelFormat::shift_9_2, .width = 16, .height = 12});
    ByteBuilder crop, table;
    crop.put(std::uint32_t{1});
    for (const int v : {2, 3, 8, 6}) crop.put(static_cast<std::uint16_t>(v));
    for (int shift = 0; shift < 64; ++shift) table.put(static_cast<std::uint16_t>(20 * shift));
    writer.add_property(1, OniRecordType::general_property, oni_property::kCropping, crop.bytes());
    writer.add_property(1, OniRecordType::general_property, oni_property::kShiftToDepth, table.bytes());
    const bool coded = pixels == OniPixelFormat::grey8;
    add_test_stream(writer, 2,
                    {.type = pixels == OniPixelFormat::grey16 ? OniNodeType::ir : OniNodeType::image,
                     .codec = coded ? OniCodec::z8 : OniCodec::none,
                     .pixels = pixels,
                     .width = 16,
                     .height = 12});
    writer.begin();
    // In Im8z: a value and 191 more, as runs.
    std::vector<std::uint8_t> grey = {9, 0x6D, 0xE5};
    grey.insert(grey.end(), 6, 0xEF);
    bool written = true;
    for (std::uint64_t k = 0; k < 3; ++k) {
      written &=
          writer.write_frame(1, 33333 * k, std::vector<std::uint8_t>(96, static_cast<std::uint8_t>(k)));
      written &= writer.write_frame(2, 33333 * k, coded ? grey : std::vector<std::uint8_t>(384, 99));
    }
    if (!written) throw std::runtime_error("no room on the disk for the seed recordings");
    writer.close();
    seeds.push_back(read_bytes(file));
  }
  return seeds;
}

/// Damages recordings: changes types, ids, lengths, sizes and coded data, and removes, repeats and inserts
/// records. The same seed gives the same mutants.
class OniMutator {
 public:
  explicit OniMutator(unsigned seed) : random_(seed) {}

  std::vector<std::uint8_t> mutate(std::vector<std::uint8_t> bytes) {
    const unsigned rounds = 1 + below(4);
    for (unsigned i = 0; i < rounds && bytes.size() > 64; ++i) change(bytes);
    return bytes;
  }

 private:
  unsigned below(std::size_t limit) { return static_cast<unsigned>(random_() % limit); }

  std::uint64_t interesting() {
    static constexpr std::array<std::uint64_t, 16> kValues = {
        0,         1,          2,          12,         27,
        28,        40,         127,        255,        32768,
        65535,     0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, ~std::uint64_t{0},
        0x0052494E};
    return below(4) == 0 ? random_() : kValues[below(kValues.size())];
  }

  // The positions of records, up to the first break of their chain.
  std::vector<std::size_t> records(const std::vector<std::uint8_t>& bytes) const {
    std::vector<std::size_t> starts;
    for (std::size_t at = 24; at + 28 <= bytes.size();) {
      starts.push_back(at);
      const std::uint64_t size =
          std::uint64_t{load_le<std::uint32_t>(&bytes[at + 12])} + load_le<std::uint32_t>(&bytes[at + 16]);
      if (load_le<std::uint32_t>(&bytes[at]) != 0x0052494E || size < 28) break;
      at += std::min<std::uint64_t>(size, bytes.size());
    }
    return starts;
  }

  void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::size_t width, std::uint64_t value) {
    for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }

  void change(std::vector<std::uint8_t>& bytes) {
    const auto starts = records(bytes);
    if (starts.size() < 2) return;
    const std::size_t pick = below(starts.size() - 1), at = starts[pick], next = starts[pick + 1];
    const auto begin = bytes.begin();
    const auto offset = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    switch (below(12)) {
      case 0:
        put(bytes, at + 4, 4, 1 + below(16));
        break;  // type
      case 1:
        put(bytes, at + 8, 4, below(2) ? 1 + below(4) : interesting());
        break;  // node
      case 2:
        put(bytes, at + 12 + 4 * below(2), 4, interesting());
        break;  // sizes
      case 3:
        put(bytes, at + 28, 4, interesting());
        break;  // a string's length, a time
      case 4:
        put(bytes, at + 28 + below(next - at), 1 + below(8), interesting());
        break;  // any field or payload
      case 5:
        for (int i = 0; i < 8; ++i) put(bytes, at + 40 + below(next - at), 1, random_());
        break;
      case 6:
        bytes.resize(below(bytes.size()));
        break;
      case 7:
        bytes.erase(offset(at), offset(next));
        break;
      case 8: {
        const std::vector<std::uint8_t> copy(offset(at), offset(next));
        bytes.insert(offset(starts[below(starts.size())]), copy.begin(), copy.end());
        break;
      }
      case 9: {
        std::vector<std::uint8_t> noise(below(100));
        for (auto& byte : noise) byte = static_cast<std::uint8_t>(random_());
        bytes.insert(offset(at + below(next - at)), noise.begin(), noise.end());
        break;
      }
      case 10:
        put(bytes, 4 + below(20), 1 + below(4), interesting());
        break;  // the file's header
      default:
        put(bytes, below(bytes.size()), 1, random_());
    }
  }

  std::mt19937_64 random_;
};

}  // namespace saccade
