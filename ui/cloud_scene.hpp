#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ui/cloud_renderer.hpp"
#include "ui/orbit_camera.hpp"
#include "ui/point_cloud.hpp"

namespace saccade {

/// A computed frame as the cloud shows it. Nothing is kept of it but `serial`.
struct CloudFrame {
  const Frame& frame;
  const cv::Mat1f& smooth;   ///< smooth_for_looking() of the map; may be empty
  const cv::Mat3f& normals;  ///< the operator's, which are better than rough ones; may be empty
  const OverlayStyle& style;
  std::int64_t serial;  ///< another one for each other frame or map
};

/// Keeps the cloud of the newest frame on the graphics card and builds it anew only when the frame, the style
/// or the choices have changed. As CloudRenderer: all calls with the same OpenGL context.
class CloudScene {
 public:
  /// Throws as CloudRenderer.
  CloudScene() = default;

  /// Draws the frame as it is asked for, if that is not what was drawn last, and returns the texture; see
  /// CloudRenderer::draw().
  unsigned render(const CloudFrame& frame, const CloudChoices& choices, const OrbitCamera& camera,
                  cv::Size size, bool light_theme);

  /// Whether the last render() drew.
  bool renewed() const { return renewed_; }

 private:
  struct Drawn {  // beside what was built
    OrbitCamera camera;
    cv::Size size;
    bool light_theme;
    bool operator==(const Drawn&) const = default;
  };
  struct Built {  // from what
    std::int64_t serial;
    CloudChoices choices;
    OverlayStyle style;
    bool operator==(const Built&) const = default;
  };
  void build(const CloudFrame& frame, const CloudChoices& choices);

  CloudRenderer renderer_;
  std::optional<Built> built_;
  std::optional<Drawn> drawn_;  // none: what was built is not drawn yet
  unsigned texture_ = 0;
  bool renewed_ = false;
  std::vector<CloudVertex> points_, lines_;
};

}  // namespace saccade
