#include "ui/viewer/texture.hpp"

#include <epoxy/gl.h>

#include <stdexcept>

namespace saccade {

Texture::~Texture() {
  if (name_ != 0) glDeleteTextures(1, &name_);
}

void Texture::upload(const cv::Mat& picture) {
  if (!picture.isContinuous() || (picture.type() != CV_8UC3 && picture.type() != CV_8UC4))
    throw std::invalid_argument("Texture: a continuous BGR or RGBA picture expected");
  if (name_ == 0) {
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GLenum format = picture.type() == CV_8UC3 ? GL_BGR : GL_RGBA;
  if (size_ != picture.size() || type_ != picture.type()) {
    size_ = picture.size();
    type_ = picture.type();
    glTexImage2D(GL_TEXTURE_2D, 0, format == GL_BGR ? GL_RGB8 : GL_RGBA8, size_.width, size_.height, 0,
                 format, GL_UNSIGNED_BYTE, picture.data);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.width, size_.height, format, GL_UNSIGNED_BYTE,
                    picture.data);
  }
}

void Texture::set_sharp(bool sharp) {
  if (name_ == 0 || sharp == sharp_) return;
  sharp_ = sharp;
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, sharp ? GL_NEAREST : GL_LINEAR);
}

}  // namespace saccade
