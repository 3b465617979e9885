#include "ui/cloud_scene.hpp"

#include <algorithm>

namespace saccade {

unsigned CloudScene::render(const CloudFrame& frame, const CloudChoices& choices, const OrbitCamera& camera,
                            cv::Size size, bool light_theme) {
  const Built wanted{frame.serial, choices, frame.style};
  if (built_ != wanted) {
    build(frame, choices);
    built_ = wanted;
    drawn_.reset();
  }
  const Drawn drawing{camera, size, light_theme};
  renewed_ = drawn_ != drawing;
  if (!renewed_) return texture_;
  CloudLook look;
  look.lit = choices.lit;
  look.point_mm_per_m = static_cast<double>(choices.point_size) * 1000 / frame.frame.intrinsics.fx;
  if (light_theme) look.background = {0.86F, 0.87F, 0.89F};
  drawn_ = drawing;
  return texture_ = renderer_.draw(camera, size, look);
}

void CloudScene::build(const CloudFrame& frame, const CloudChoices& choices) {
  constexpr int kNeedleEvery_px = 8;
  cv::Mat3f normals;
  if (choices.lit || choices.needles)
    normals =
        frame.normals.empty() ? rough_normals(frame.frame.depth_mm, frame.frame.intrinsics) : frame.normals;
  build_cloud(frame.frame, cloud_colours(choices.colour, frame.frame, frame.smooth, frame.style), normals,
              points_);
  renderer_.set_points(points_);
  lines_.clear();
  // As long as two of the steps between them at 1 m.
  if (choices.needles)
    build_normal_lines(frame.frame, normals, kNeedleEvery_px,
                       static_cast<float>(2 * kNeedleEvery_px * 1000 / frame.frame.intrinsics.fx), lines_);
  renderer_.set_lines(lines_);
}

}  // namespace saccade
