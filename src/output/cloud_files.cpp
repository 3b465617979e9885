#include "output/cloud_files.hpp"

#include <array>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace saccade {
namespace {

using Bytes = std::vector<std::uint8_t>;

const cv::Vec3b kNoColour(160, 160, 160);

void append(Bytes& bytes, const void* data, std::size_t size) {
  const auto* begin = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
}

cv::Vec3b colour_at(const Frame& frame, int row, int col) {
  return frame.colour.empty() ? kNoColour : frame.colour(row, col);
}

std::string ply_header(const Frame& frame, bool normals) {
  const Intrinsics& camera = frame.intrinsics;
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\nobj_info num_cols {}\nobj_info num_rows {}\n"
      "obj_info camera {} {} {} {}\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\n{}property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      frame.size().width, frame.size().height, camera.fx, camera.fy, camera.cx, camera.cy,
      cv::countNonZero(frame.depth_mm > 0),
      normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "");
}

}  // namespace

Bytes encode_ply(const Frame& frame, const cv::Mat3f& normals) {
  const bool with_normals = normals.size() == frame.size();
  const std::string header = ply_header(frame, with_normals);
  Bytes bytes(header.begin(), header.end());
  bytes.reserve(bytes.size() + frame.depth_mm.total() * (with_normals ? 27 : 15));
  for (int row = 0; row < frame.depth_mm.rows; ++row)
    for (int col = 0; col < frame.depth_mm.cols; ++col) {
      const auto z = static_cast<double>(frame.depth_mm(row, col));
      if (!(z > 0)) continue;
      const cv::Point3f point = frame.intrinsics.point_mm(row, col, z);
      append(bytes, &point, sizeof point);
      if (with_normals) append(bytes, &normals(row, col), sizeof(cv::Vec3f));
      const cv::Vec3b bgr = colour_at(frame, row, col);
      const std::array<std::uint8_t, 3> rgb = {bgr[2], bgr[1], bgr[0]};
      append(bytes, rgb.data(), sizeof rgb);
    }
  return bytes;
}

Bytes encode_pcd(const Frame& frame) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  constexpr double kMmPerMetre = 1000;
  const cv::Size size = frame.size();
  const std::string header = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\n"
      "TYPE F F F U\nCOUNT 1 1 1 1\nWIDTH {}\nHEIGHT {}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      size.width, size.height, size.area());
  Bytes bytes(header.begin(), header.end());
  bytes.reserve(bytes.size() + frame.depth_mm.total() * 16);
  for (int row = 0; row < size.height; ++row)
    for (int col = 0; col < size.width; ++col) {
      const auto z = static_cast<double>(frame.depth_mm(row, col));
      const cv::Point3f point = z > 0 ? cv::Point3f(frame.intrinsics.point_mm(row, col, z) / kMmPerMetre)
                                      : cv::Point3f(kNone, kNone, kNone);
      append(bytes, &point, sizeof point);
      const cv::Vec3b bgr = colour_at(frame, row, col);
      const std::array<std::uint8_t, 4> rgb = {bgr[0], bgr[1], bgr[2], 0};  // 0x00RRGGBB, little-endian
      append(bytes, rgb.data(), sizeof rgb);
    }
  return bytes;
}

}  // namespace saccade
