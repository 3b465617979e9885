#pragma once

#include <opencv2/core.hpp>

#include "core/intrinsics.hpp"
#include "scene/scene.hpp"

namespace saccade::scene {

/// The images of an ideal camera. All H x W.
struct SceneRender {
  cv::Mat1f depth_mm;  ///< along the optical axis, computed in double; 0 = the ray hits nothing
  cv::Mat3f normals;   ///< unit, camera frame, towards the camera; (0,0,0) = no surface
  cv::Mat1w labels;    ///< Part::label; 0 where there is no surface
  cv::Mat1w parts;     ///< index into Scene::parts plus 1; 0 = no surface
  cv::Mat3b colour;    ///< BGR
};

/// Casts a ray through the centre of each pixel (README 3). Reuses the memory of `out` if it fits. One
/// thread. Throws std::invalid_argument for invalid intrinsics or an empty size.
void render(const Scene& scene, const Intrinsics& camera, cv::Size size, const Pose& pose, SceneRender& out);

}  // namespace saccade::scene
