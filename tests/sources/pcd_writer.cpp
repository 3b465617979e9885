#include "pcd_writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Point = std::array<float, 4>;

float packed(const cv::Vec3b& bgr) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bgr[2] << 16 | bgr[1] << 8 | bgr[0]));
}

template <typename Value>
void append(Bytes& bytes, const Value& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(value));
  std::memcpy(bytes.data() + at, &value, sizeof(value));
}

std::vector<Point> points_of(const cv::Mat1f& depth_mm, const Intrinsics& camera, const cv::Mat3b& colour) {
  std::vector<Point> points;
  for (int r = 0; r < depth_mm.rows; ++r)
    for (int c = 0; c < depth_mm.cols; ++c) {
      const cv::Point3d p = camera.point_mm(r, c, static_cast<double>(depth_mm(r, c))) / 1000;
      const float none = std::nanf("");
      const float rgb = colour.empty() ? 0 : packed(colour(r, c));
      if (p.z > 0)
        points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), rgb});
      else
        points.push_back({none, none, none, rgb});
    }
  return points;
}

// A plain LZF encoder: the longest match among the last few hundred bytes, looked for one by one.
Bytes compress(const Bytes& plain) {
  constexpr std::size_t kFarthest = 300, kLongest = 264, kLiterals = 32;
  Bytes out, literals;
  const auto flush = [&] {
    if (literals.empty()) return;
    out.push_back(static_cast<std::uint8_t>(literals.size() - 1));
    out.insert(out.end(), literals.begin(), literals.end());
    literals.clear();
  };
  for (std::size_t at = 0; at < plain.size();) {
    std::size_t best = 0, best_back = 0;
    for (std::size_t back = 1; back <= std::min(at, kFarthest); ++back) {
      std::size_t length = 0;
      while (length < kLongest && at + length < plain.size() &&
             plain[at + length] == plain[at + length - back])
        ++length;
      if (length > best) best = length, best_back = back - 1;
    }
    if (best < 3) {
      literals.push_back(plain[at++]);
      if (literals.size() == kLiterals) flush();
      continue;
    }
    flush();
    const std::size_t code = best - 2;
    out.push_back(static_cast<std::uint8_t>(std::min<std::size_t>(code, 7) << 5 | best_back >> 8));
    if (code >= 7) out.push_back(static_cast<std::uint8_t>(code - 7));
    out.push_back(static_cast<std::uint8_t>(best_back & 255));
    at += best;
  }
  flush();
  return out;
}

}  // namespace

std::string to_string(PcdEncoding encoding) {
  constexpr std::array<const char*, 3> kNames = {"ascii", "binary", "binary_compressed"};
  return kNames[static_cast<std::size_t>(encoding)];
}

Bytes write_pcd(const cv::Mat1f& depth_mm, const Intrinsics& camera, PcdEncoding encoding,
                const cv::Mat3b& colour) {
  const std::size_t fields = colour.empty() ? 3 : 4;
  const auto repeated = [&](const char* word) {
    return fmt::format("{0} {0} {0}{1}", word, fields == 4 ? fmt::format(" {}", word) : "");
  };
  const std::string header = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z{}\nSIZE {}\nTYPE {}\nCOUNT {}\n"
      "WIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      fields == 4 ? " rgb" : "", repeated("4"), repeated("F"), repeated("1"), depth_mm.cols, depth_mm.rows,
      depth_mm.total(), to_string(encoding));
  Bytes bytes(header.begin(), header.end());
  const auto points = points_of(depth_mm, camera, colour);
  if (encoding == PcdEncoding::ascii) {
    for (const Point& p : points) {
      const std::string line =
          fmt::format("{}\n", fmt::join(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(fields), " "));
      bytes.insert(bytes.end(), line.begin(), line.end());
    }
  } else if (encoding == PcdEncoding::binary) {
    for (const Point& p : points)
      for (std::size_t field = 0; field < fields; ++field) append(bytes, p[field]);
  } else {
    Bytes plain;
    for (std::size_t field = 0; field < fields; ++field)
      for (const Point& p : points) append(plain, p[field]);
    const Bytes packed_bytes = compress(plain);
    append(bytes, static_cast<std::uint32_t>(packed_bytes.size()));
    append(bytes, static_cast<std::uint32_t>(plain.size()));
    bytes.insert(bytes.end(), packed_bytes.begin(), packed_bytes.end());
  }
  return bytes;
}

}  // namespace saccade
