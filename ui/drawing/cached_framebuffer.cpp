#include "ui/drawing/cached_framebuffer.hpp"

#include <algorithm>
#include <vector>

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>

#include <opencv2/imgproc.hpp>

namespace saccade {
namespace {

std::span<ImDrawList* const> lists_of(const ImDrawData& data) {
  return {data.CmdLists, static_cast<std::size_t>(data.CmdListsCount)};
}

// The clip rectangles of all commands, list by list.
std::vector<ImVec4> clips_of(const ImDrawData& data) {
  std::vector<ImVec4> clips;
  for (const ImDrawList* list : lists_of(data))
    for (const ImDrawCmd& command : list->CmdBuffer) clips.push_back(command.ClipRect);
  return clips;
}

// Cuts the drawing, whose clip rectangles were `clips`, to a part of the framebuffer.
void clip_to(ImDrawData& data, const std::vector<ImVec4>& clips, const cv::Rect& part) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const ImVec4 seen{origin.x + static_cast<float>(part.x) / scale.x,
                    origin.y + static_cast<float>(part.y) / scale.y,
                    origin.x + static_cast<float>(part.x + part.width) / scale.x,
                    origin.y + static_cast<float>(part.y + part.height) / scale.y};
  auto clip = clips.begin();
  for (ImDrawList* list : lists_of(data))
    for (ImDrawCmd& command : list->CmdBuffer) {
      command.ClipRect = {std::max(clip->x, seen.x), std::max(clip->y, seen.y), std::min(clip->z, seen.z),
                          std::min(clip->w, seen.w)};
      ++clip;
    }
}

}  // namespace

CachedFramebuffer::CachedFramebuffer() {
  glGenFramebuffers(1, &framebuffer_);
  glGenRenderbuffers(1, &pixels_);
}

CachedFramebuffer::~CachedFramebuffer() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &pixels_);
}

// With framebuffer_ bound.
void CachedFramebuffer::resize(cv::Size size) {
  if (size == size_) return;
  size_ = size;
  glBindRenderbuffer(GL_RENDERBUFFER, pixels_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.width, size.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels_);
  tracker_.reset();
}

bool CachedFramebuffer::draw(ImDrawData& data, const cv::Scalar& background,
                             std::span<const TextureId> renewed) {
  const cv::Size size(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                      static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
  if (size.empty()) return false;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  resize(size);
  if (background != background_) tracker_.reset();
  background_ = background;
  const std::vector<cv::Rect> damage = tracker_.damage(data, renewed);
  const std::vector<ImVec4> clips = clips_of(data);
  glViewport(0, 0, size.width, size.height);
  glClearColor(static_cast<float>(background[0]), static_cast<float>(background[1]),
               static_cast<float>(background[2]), 1);
  for (const cv::Rect& part : damage) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x, size.height - part.y - part.height, part.width, part.height);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    clip_to(data, clips, part);
    ImGui_ImplOpenGL3_RenderDrawData(&data);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return !damage.empty();
}

void CachedFramebuffer::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

cv::Mat3b CachedFramebuffer::read_pixels() const {
  cv::Mat3b pixels(size_), upright;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_.width, size_.height, GL_BGR, GL_UNSIGNED_BYTE, pixels.data);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  cv::flip(pixels, upright, 0);
  return upright;
}

}  // namespace saccade
