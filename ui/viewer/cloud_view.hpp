#pragma once

#include <memory>

#include "ui/cloud_panel.hpp"
#include "ui/cloud_scene.hpp"
#include "ui/viewer/view_context.hpp"

namespace saccade {

/// The point cloud of A's result in the middle of the window.
class CloudView {
 public:
  void draw(ViewContext& view);
  void fit() { state_.placed = false; }

 private:
  std::unique_ptr<CloudScene> scene_;  // made when it is first seen: it needs the OpenGL context
  CloudPanelState state_;
};

}  // namespace saccade
