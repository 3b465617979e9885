#include "ui/session/cloud_vertices.hpp"

#include <cmath>
#include <stdexcept>

namespace saccade {
namespace {

void check_size(const Frame& frame, cv::Size size, const char* who) {
  if (frame.size() != size) throw std::invalid_argument(std::string(who) + ": images of one size expected");
}

// The points of a depth image; the rays of its columns and rows are computed once.
class Points {
 public:
  explicit Points(const cv::Mat1f& depth_mm, const Intrinsics& camera) : depth_(depth_mm) {
    for (int c = 0; c < depth_mm.cols; ++c) x_.push_back(static_cast<float>((c - camera.cx) / camera.fx));
    for (int r = 0; r < depth_mm.rows; ++r) y_.push_back(static_cast<float>((r - camera.cy) / camera.fy));
  }

  cv::Vec3f operator()(int r, int c) const {
    const float z = depth_(r, c);
    return {x_[static_cast<std::size_t>(c)] * z, y_[static_cast<std::size_t>(r)] * z, z};
  }

 private:
  const cv::Mat1f& depth_;
  std::vector<float> x_, y_;
};

std::int8_t to_byte(float part) { return static_cast<std::int8_t>(std::lround(127 * part)); }

}  // namespace

cv::Mat3b cloud_colours(CloudColour by, const Frame& frame, const cv::Mat1f& smooth,
                        const OverlayStyle& style) {
  if (by == CloudColour::depth) return depth_picture(frame.depth_mm, style.depth);
  OverlayStyle image = style;
  image.background = Background::colour;
  cv::Mat3b picture = draw_background(frame, image);
  if (by == CloudColour::image || smooth.empty()) return picture;
  check_size(frame, smooth.size(), "cloud_colours");
  blend_map(picture, shown_strength(smooth, style.map), style.map);
  return picture;
}

cv::Mat3f rough_normals(const cv::Mat1f& depth_mm, const Intrinsics& camera) {
  constexpr float kSameSurface = 0.02F;
  const Points points(depth_mm, camera);
  cv::Mat3f normals(depth_mm.size(), cv::Vec3f());
  for (int r = 1; r + 1 < depth_mm.rows; ++r)
    for (int c = 1; c + 1 < depth_mm.cols; ++c) {
      const float z = depth_mm(r, c), limit = kSameSurface * z;
      const auto continues = [&](float other) { return std::abs(other - z) <= limit; };
      if (z == 0 || !continues(depth_mm(r, c - 1)) || !continues(depth_mm(r, c + 1)) ||
          !continues(depth_mm(r - 1, c)) || !continues(depth_mm(r + 1, c)))
        continue;
      const cv::Vec3f across = points(r, c + 1) - points(r, c - 1),
                      down = points(r + 1, c) - points(r - 1, c);
      normals(r, c) = cv::normalize(down.cross(across));  // y x x = -z: towards the camera
    }
  return normals;
}

void build_cloud(const Frame& frame, const cv::Mat3b& colours, const cv::Mat3f& normals,
                 std::vector<CloudVertex>& vertices) {
  check_size(frame, colours.size(), "build_cloud");
  if (!normals.empty()) check_size(frame, normals.size(), "build_cloud");
  const Points points(frame.depth_mm, frame.intrinsics);
  vertices.clear();
  for (int r = 0; r < colours.rows; ++r)
    for (int c = 0; c < colours.cols; ++c) {
      if (frame.depth_mm(r, c) == 0) continue;
      const cv::Vec3f p = points(r, c);
      const cv::Vec3b& bgr = colours(r, c);
      const cv::Vec3f n = normals.empty() ? cv::Vec3f() : normals(r, c);
      vertices.push_back({{p[0], p[1], p[2]},
                          {bgr[2], bgr[1], bgr[0], 255},
                          {to_byte(n[0]), to_byte(n[1]), to_byte(n[2]), 0}});
    }
}

void build_normal_lines(const Frame& frame, const cv::Mat3f& normals, int every, float length_mm,
                        std::vector<CloudVertex>& vertices) {
  check_size(frame, normals.size(), "build_normal_lines");
  if (every < 1) throw std::invalid_argument("build_normal_lines: every >= 1 expected");
  constexpr std::array<std::uint8_t, 4> kFoot = {90, 200, 255, 255}, kTip = {255, 255, 255, 255};
  const Points points(frame.depth_mm, frame.intrinsics);
  vertices.clear();
  for (int r = every / 2; r < normals.rows; r += every)
    for (int c = every / 2; c < normals.cols; c += every) {
      const cv::Vec3f& n = normals(r, c);
      if (n == cv::Vec3f()) continue;
      const cv::Vec3f foot = points(r, c), tip = foot + length_mm * n;
      vertices.push_back({{foot[0], foot[1], foot[2]}, kFoot, {}});
      vertices.push_back({{tip[0], tip[1], tip[2]}, kTip, {}});
    }
}

}  // namespace saccade
