#include "ui/drawing/gl_graphics.hpp"

#include <utility>

#include "ui/drawing/gl_cloud_picture.hpp"
#include "ui/drawing/gl_texture.hpp"

namespace saccade {

std::unique_ptr<PictureTexture> GlGraphics::make_texture() { return std::make_unique<GlTexture>(renewed_); }

std::unique_ptr<CloudPicture> GlGraphics::make_cloud_picture() {
  return std::make_unique<GlCloudPicture>(renewed_);
}

std::vector<TextureId> GlGraphics::take_renewed() { return std::exchange(renewed_, {}); }

}  // namespace saccade
