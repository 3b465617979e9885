#include "ui/drawing/gl_texture.hpp"

#include <epoxy/gl.h>

#include <opencv2/imgproc.hpp>

namespace saccade {

GlTexture::~GlTexture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

void GlTexture::upload(const cv::Mat3b& picture) {
  cv::cvtColor(picture, pixels_, cv::COLOR_BGR2BGRA);
  if (name_ == 0) {
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  // BGRA of 8 bits is what graphics cards keep: nothing needs to be converted.
  if (size_ != picture.size()) {
    size_ = picture.size();
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_.width, size_.height, 0, GL_BGRA,
                 GL_UNSIGNED_INT_8_8_8_8_REV, pixels_.data);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.width, size_.height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                    pixels_.data);
  }
  renewed_.push_back(id());
}

void GlTexture::set_sharp(bool sharp) {
  if (name_ == 0 || sharp == sharp_) return;
  sharp_ = sharp;
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sharp ? GL_NEAREST : GL_LINEAR);
  renewed_.push_back(id());
}

}  // namespace saccade
