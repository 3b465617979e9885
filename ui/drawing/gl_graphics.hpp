#pragma once

#include <vector>

#include "ui/session/graphics.hpp"

namespace saccade {

/// Graphics by OpenGL 3.3; all calls with its context current. Outlives what it makes.
class GlGraphics final : public Graphics {
 public:
  [[nodiscard]] std::unique_ptr<PictureTexture> make_texture() override;
  [[nodiscard]] std::unique_ptr<CloudPicture> make_cloud_picture() override;

  /// The textures whose pixels have changed since the last call.
  [[nodiscard]] std::vector<TextureId> take_renewed();

 private:
  std::vector<TextureId> renewed_;
};

}  // namespace saccade
