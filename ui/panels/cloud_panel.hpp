#pragma once

#include <memory>

#include "ui/panels/cloud_drawing.hpp"
#include "ui/panels/view_context.hpp"

namespace saccade {

/// The point cloud of A's result in the middle of the window.
class CloudPanel {
 public:
  void draw(ViewContext& view);

  /// The sensor's own view, from the next frame on.
  void fit() { state_.placed = false; }

 private:
  std::unique_ptr<CloudPicture> picture_;  // made when it is first seen
  CloudPanelState state_;
};

}  // namespace saccade
