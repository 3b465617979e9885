#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ui/drawing/cloud_renderer.hpp"
#include "ui/session/graphics.hpp"

namespace saccade {

/// CloudPicture by OpenGL. Keeps the cloud of the newest frame on the graphics card and builds it again only
/// when the frame or a style has changed. All calls, also the destructor's, with the same context current.
class GlCloudPicture final : public CloudPicture {
 public:
  /// Adds its texture to `renewed` whenever that is drawn.
  explicit GlCloudPicture(std::vector<TextureId>& renewed) : renewed_(renewed) {}

  TextureId render(const CloudFrame& frame, const CloudStyle& style, const OrbitCamera& camera, cv::Size size,
                   bool light_theme) override;

 private:
  struct Drawn {  // besides what was built
    OrbitCamera camera;
    cv::Size size;
    bool light_theme;
    bool operator==(const Drawn&) const = default;
  };
  struct Built {
    std::int64_t serial;
    CloudStyle style;
    OverlayStyle overlay;
    bool operator==(const Built&) const = default;
  };
  void build(const CloudFrame& frame, const CloudStyle& style);

  std::vector<TextureId>& renewed_;
  CloudRenderer renderer_;
  std::optional<Built> built_;
  std::optional<Drawn> drawn_;  // none: what was built is not drawn yet
  TextureId texture_ = 0;
  std::vector<CloudVertex> points_, lines_;
};

}  // namespace saccade
