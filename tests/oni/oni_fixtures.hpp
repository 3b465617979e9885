#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/frame.hpp"
#include "oni/bytes.hpp"
#include "oni/properties.hpp"
#include "oni/record_writer.hpp"
#include "oni/writer.hpp"
#include "tests/support/folder_test.hpp"

namespace saccade {

class OniFiles : public FolderTest {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
};

inline std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// A slanted plane with holes and steps in integer millimetres, one for each `seed`; colour is optional.
inline Frame test_frame(int seed, cv::Size size, bool colour) {
  Frame frame;
  frame.index = seed;
  frame.timestamp_us = 1'000'000 + 33'333 * std::int64_t{seed};
  frame.intrinsics = {500.25, 501.5, size.width / 2.0 + 0.125, size.height / 2.0 - 0.375,
                      IntrinsicsOrigin::sensor};
  frame.depth_mm.create(size);
  std::mt19937 random(static_cast<unsigned>(seed));
  for (int row = 0; row < size.height; ++row)
    for (int col = 0; col < size.width; ++col) {
      const int noise = static_cast<int>(random() % 3);
      const bool hole = (row / 3 + col / 5 + seed) % 7 == 0;
      frame.depth_mm(row, col) =
          hole ? 0.0f : static_cast<float>(800 + 9 * row + 2 * col + noise + 100 * seed);
    }
  if (!colour) return frame;
  frame.colour.create(size);
  for (int row = 0; row < size.height; ++row)
    for (int col = 0; col < size.width; ++col)
      frame.colour(row, col) =
          cv::Vec3b(static_cast<std::uint8_t>(row * 4), static_cast<std::uint8_t>(col * 4),
                    static_cast<std::uint8_t>(40 * seed));
  return frame;
}

/// Records frames 0..count-1 of test_frame().
inline void record_test_frames(const std::filesystem::path& path, int count, cv::Size size, bool colour,
                               OniWriterOptions options = {}) {
  OniWriter writer(path, options);
  for (int k = 0; k < count; ++k) writer.write(test_frame(k, size, colour));
  writer.close();
}

inline bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// A stream for a test, valid or not.
struct TestStream {
  OniNodeType type = OniNodeType::depth;
  OniCodec codec = OniCodec::none;
  OniPixelFormat pixels = OniPixelFormat::depth_1mm;
  std::uint32_t width = 4, height = 3, rate = 30;
};

inline void add_test_stream(OniRecordWriter& writer, std::uint32_t node, const TestStream& stream) {
  OniNodeFields fields;
  fields.name = "Test";
  fields.type = stream.type;
  fields.codec = stream.codec;
  writer.add_node(node, fields);
  ByteBuilder mode;
  mode.put(stream.width);
  mode.put(stream.height);
  mode.put(stream.rate);
  writer.add_property(node, OniRecordType::general_property, oni_property::kMode, mode.bytes());
  writer.add_int(node, oni_property::kOniFormat, static_cast<std::uint64_t>(stream.pixels));
  writer.add_property(node, OniRecordType::general_property, oni_property::kCropping,
                      std::array<std::uint8_t, 12>{});
}

}  // namespace saccade
