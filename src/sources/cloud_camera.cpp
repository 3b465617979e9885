#include "sources/cloud_camera.hpp"

#include <cmath>

namespace saccade {
namespace {

// A least-squares line position = focal * slope + centre, slope = x/z or y/z.
class LineFit {
 public:
  void add(double slope, double position) {
    ++n_;
    s_ += slope;
    p_ += position;
    ss_ += slope * slope;
    sp_ += slope * position;
  }
  double focal() const { return (n_ * sp_ - s_ * p_) / (n_ * ss_ - s_ * s_); }
  double centre() const { return (p_ - focal() * s_) / n_; }

 private:
  double n_ = 0, s_ = 0, p_ = 0, ss_ = 0, sp_ = 0;
};

}  // namespace

bool is_seen(const cv::Point3d& p) {
  constexpr double kFarthest_m = 1e4;
  return std::isfinite(p.x) && std::isfinite(p.y) && p.z > 0 && p.z < kFarthest_m;
}

std::optional<Intrinsics> fit_camera(std::span<const cv::Point3d> points, cv::Size size) {
  constexpr int kFewest = 100;
  LineFit across, down;
  int count = 0;
  const auto for_each_point = [&](auto use) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (is_seen(points[i])) {
        const auto width = static_cast<std::size_t>(size.width);
        const std::size_t row = i / width, col = i % width;
        use(points[i], static_cast<double>(row), static_cast<double>(col));
      }
  };
  for_each_point([&](const cv::Point3d& p, double row, double col) {
    across.add(p.x / p.z, col);
    down.add(p.y / p.z, row);
    ++count;
  });
  const Intrinsics camera{across.focal(), down.focal(), across.centre(), down.centre(),
                          IntrinsicsOrigin::file};
  if (count < kFewest || !camera.valid()) return std::nullopt;
  double error_px = 0;
  for_each_point([&](const cv::Point3d& p, double row, double col) {
    error_px += std::hypot(camera.fx * p.x / p.z + camera.cx - col, camera.fy * p.y / p.z + camera.cy - row);
  });
  if (error_px / count > 1) return std::nullopt;
  return camera;
}

}  // namespace saccade
