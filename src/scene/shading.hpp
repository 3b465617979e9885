#pragma once

#include "scene/render.hpp"

namespace saccade::scene {

/// Fills `out.colour` from its depth, normals and parts: Lambert's law for a lamp with hard shadows, light
/// from the sky and a little from the camera's side, a highlight on glossy parts, and the parts' textures.
void shade(const Scene& scene, const Intrinsics& camera, const Pose& pose, SceneRender& out);

}  // namespace saccade::scene
