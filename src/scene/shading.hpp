#pragma once

#include "scene/render.hpp"

namespace saccade::scene {

/// Fills `out.colour` from its depth, normals and parts (README 4): Lambert's law for a lamp with hard
/// shadows, light from the sky and a little from the camera, a highlight on glossy parts, and the textures.
void shade(const Scene& scene, const Intrinsics& camera, const Pose& pose, SceneRender& out);

}  // namespace saccade::scene
