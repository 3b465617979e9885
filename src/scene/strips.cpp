#include "scene/strips.hpp"

#include <algorithm>

#include "scene/random.hpp"

namespace saccade::scene {

void remove_strips(std::uint64_t key, double share, cv::Mat1f& depth_mm) {
  // 20 px of 640: the shadow of an object at 0.9 m on a wall at 1.6 m, for a focal length of 525 px and a
  // projector 75 mm beside the camera, 525 * 75 * (1/900 - 1/1600).
  const cv::Size strip(std::max(1, depth_mm.cols / 32), std::max(1, depth_mm.rows / 8));
  const int pixels = static_cast<int>(depth_mm.total());
  Random random(key);
  for (int missing = pixels - cv::countNonZero(depth_mm); missing < share * pixels;) {
    const cv::Point corner{random.integer(0, depth_mm.cols - 1), random.integer(0, depth_mm.rows - 1)};
    cv::Mat1f taken = depth_mm(cv::Rect(corner, strip) & cv::Rect({0, 0}, depth_mm.size()));
    missing += cv::countNonZero(taken);
    taken = 0;
  }
}

}  // namespace saccade::scene
