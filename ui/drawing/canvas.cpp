#include "ui/drawing/canvas.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <opencv2/imgproc.hpp>

namespace saccade {

Canvas::Canvas() {
  glGenFramebuffers(1, &framebuffer_);
  glGenRenderbuffers(1, &pixels_);
}

Canvas::~Canvas() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &pixels_);
}

// With framebuffer_ bound.
void Canvas::resize(cv::Size size) {
  if (size == size_) return;
  size_ = size;
  glBindRenderbuffer(GL_RENDERBUFFER, pixels_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.width, size.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels_);
  memory_.forget();
}

bool Canvas::draw(ImDrawData& data, const cv::Scalar& background, std::span<const ImTextureID> renewed) {
  const cv::Size size(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                      static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
  if (size.empty()) return false;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  resize(size);
  if (background != background_) memory_.forget();
  background_ = background;
  const std::vector<cv::Rect> parts = memory_.changes(data, renewed);
  const std::vector<ImVec4> clips = clips_of(data);
  glViewport(0, 0, size.width, size.height);
  glClearColor(static_cast<float>(background[0]), static_cast<float>(background[1]),
               static_cast<float>(background[2]), 1);
  for (const cv::Rect& part : parts) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x, size.height - part.y - part.height, part.width, part.height);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    cut(data, clips, part);
    ImGui_ImplOpenGL3_RenderDrawData(&data);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return !parts.empty();
}

void Canvas::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

cv::Mat3b Canvas::picture() const {
  cv::Mat3b pixels(size_), upright;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_.width, size_.height, GL_BGR, GL_UNSIGNED_BYTE, pixels.data);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  cv::flip(pixels, upright, 0);
  return upright;
}

}  // namespace saccade
