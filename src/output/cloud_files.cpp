#include "output/cloud_files.hpp"

#include <cstring>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Values side by side, in memory that holds all of them.
class Record {
 public:
  explicit Record(std::uint8_t* at) : at_(at) {}

  template <typename Value>
  void put(const Value& value) {
    std::memcpy(at_, &value, sizeof value);
    at_ += sizeof value;
  }
  template <typename Value, int count>
  void put(const cv::Vec<Value, count>& values) {  // not trivially copyable, its elements are
    put(values.val);
  }

 private:
  std::uint8_t* at_;
};

// Room for `points` records of `point_bytes` behind a header; `body`: where they begin.
Bytes with_room(const std::string& header, std::size_t points, std::size_t point_bytes, Record& body) {
  Bytes bytes(header.size() + points * point_bytes);
  std::memcpy(bytes.data(), header.data(), header.size());
  body = Record(bytes.data() + header.size());
  return bytes;
}

std::string ply_header(const Frame& frame, std::size_t points, bool normals, bool colour) {
  const Intrinsics& camera = frame.intrinsics;
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\nobj_info num_cols {}\nobj_info num_rows {}\n"
      "obj_info camera {} {} {} {}\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\n{}{}end_header\n",
      frame.size().width, frame.size().height, camera.fx, camera.fy, camera.cx, camera.cy, points,
      normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
      colour ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
}

}  // namespace

Bytes encode_ply(const Frame& frame, const cv::Mat3f& normals) {
  const bool with_normals = normals.size() == frame.size(), with_colour = !frame.colour.empty();
  const auto points = static_cast<std::size_t>(cv::countNonZero(frame.depth_mm > 0));
  Record record(nullptr);
  Bytes bytes = with_room(ply_header(frame, points, with_normals, with_colour), points,
                          12U + (with_normals ? 12U : 0U) + (with_colour ? 3U : 0U), record);
  for (int row = 0; row < frame.depth_mm.rows; ++row)
    for (int col = 0; col < frame.depth_mm.cols; ++col) {
      const auto z = static_cast<double>(frame.depth_mm(row, col));
      if (!(z > 0)) continue;
      record.put(cv::Point3f(frame.intrinsics.point_mm(row, col, z)));
      if (with_normals) record.put(normals(row, col));
      if (!with_colour) continue;
      const cv::Vec3b bgr = frame.colour(row, col);
      record.put(cv::Vec3b(bgr[2], bgr[1], bgr[0]));
    }
  return bytes;
}

Bytes encode_pcd(const Frame& frame) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  constexpr double kMmPerMetre = 1000;
  const cv::Size size = frame.size();
  const bool with_colour = !frame.colour.empty();
  const std::string header = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z{}\nSIZE 4 4 4{}\n"
      "TYPE F F F{}\nCOUNT 1 1 1{}\nWIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      with_colour ? " rgb" : "", with_colour ? " 4" : "", with_colour ? " U" : "", with_colour ? " 1" : "",
      size.width, size.height, size.area());
  Record record(nullptr);
  Bytes bytes = with_room(header, frame.depth_mm.total(), with_colour ? 16 : 12, record);
  for (int row = 0; row < size.height; ++row)
    for (int col = 0; col < size.width; ++col) {
      const auto z = static_cast<double>(frame.depth_mm(row, col));
      record.put(z > 0 ? cv::Point3f(frame.intrinsics.point_mm(row, col, z) / kMmPerMetre)
                       : cv::Point3f(kNone, kNone, kNone));
      if (!with_colour) continue;
      const cv::Vec3b bgr = frame.colour(row, col);
      record.put(cv::Vec4b(bgr[0], bgr[1], bgr[2], 0));  // 0x00RRGGBB, little-endian
    }
  return bytes;
}

}  // namespace saccade
