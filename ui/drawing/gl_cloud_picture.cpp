#include "ui/drawing/gl_cloud_picture.hpp"

#include <algorithm>

namespace saccade {

TextureId GlCloudPicture::render(const CloudFrame& frame, const CloudStyle& style, const OrbitCamera& camera,
                                 cv::Size size, bool light_theme) {
  const Built wanted{frame.serial, style, frame.style};
  if (built_ != wanted) {
    build(frame, style);
    built_ = wanted;
    drawn_.reset();
  }
  const Drawn drawing{camera, size, light_theme};
  if (drawn_ == drawing) return texture_;
  CloudShading shading;
  shading.lit = style.lit;
  shading.point_mm_per_m = static_cast<double>(style.point_size) * 1000 / frame.frame.intrinsics.fx;
  if (light_theme) shading.background = {0.86F, 0.87F, 0.89F};
  drawn_ = drawing;
  texture_ = renderer_.draw(camera, size, shading);
  renewed_.push_back(texture_);
  return texture_;
}

void GlCloudPicture::build(const CloudFrame& frame, const CloudStyle& style) {
  constexpr int kNeedleEvery_px = 8;
  cv::Mat3f normals;
  if (style.lit || style.needles)
    normals =
        frame.normals.empty() ? rough_normals(frame.frame.depth_mm, frame.frame.intrinsics) : frame.normals;
  build_cloud(frame.frame, cloud_colours(style.colour, frame.frame, frame.smooth, frame.style), normals,
              points_);
  renderer_.set_points(points_);
  lines_.clear();
  // As long as two of the steps between them at 1 m.
  if (style.needles)
    build_normal_lines(frame.frame, normals, kNeedleEvery_px,
                       static_cast<float>(2 * kNeedleEvery_px * 1000 / frame.frame.intrinsics.fx), lines_);
  renderer_.set_lines(lines_);
}

}  // namespace saccade
