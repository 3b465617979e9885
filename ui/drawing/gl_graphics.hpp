#pragma once

#include "ui/session/graphics.hpp"

namespace saccade {

/// Graphics by OpenGL 3.3; all calls with its context current.
class GlGraphics final : public Graphics {
 public:
  [[nodiscard]] std::unique_ptr<PictureTexture> make_texture() override;
  [[nodiscard]] std::unique_ptr<CloudPicture> make_cloud_picture() override;
};

}  // namespace saccade
