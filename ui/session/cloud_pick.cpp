#include "ui/session/cloud_pick.hpp"

#include <limits>

namespace saccade {

std::optional<cv::Point> pixel_at(const OrbitCamera& camera, const Frame& frame, cv::Point2d pointer_px,
                                  cv::Size viewport, double reach_px) {
  const cv::Point3d eye(camera.eye_mm());
  std::optional<cv::Point> found;
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (int r = 0; r < frame.depth_mm.rows; ++r)
    for (int c = 0; c < frame.depth_mm.cols; ++c) {
      const auto z = static_cast<double>(frame.depth_mm(r, c));
      if (!(z > 0)) continue;
      const cv::Point3d point = frame.intrinsics.point_mm(r, c, z);
      const double distance_mm = cv::norm(point - eye);
      if (distance_mm >= nearest_mm) continue;
      const auto at = camera.project(point, viewport);
      if (!at || cv::norm(*at - pointer_px) > reach_px) continue;
      nearest_mm = distance_mm;
      found = cv::Point(c, r);
    }
  return found;
}

}  // namespace saccade
