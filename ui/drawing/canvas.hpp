#pragma once

#include <span>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "ui/drawing/draw_memory.hpp"

namespace saccade {

/// The picture of the window, kept from frame to frame, into which only what has changed is drawn. All calls
/// with the same OpenGL context current, in which ImGui's backend was started.
class Canvas {
 public:
  Canvas();
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Brings the picture to what `data` says, over `background` (red, green, blue; 0..1). `renewed`:
  /// textures whose pixels have changed. Returns whether anything was drawn. Cuts the clip rectangles of
  /// `data`.
  bool draw(ImDrawData& data, const cv::Scalar& background, std::span<const ImTextureID> renewed);

  /// Everything is drawn anew the next time.
  void forget() { memory_.forget(); }

  /// Copies the picture into the window.
  void show() const;

  /// BGR.
  cv::Mat3b picture() const;

 private:
  void resize(cv::Size size);

  DrawMemory memory_;
  unsigned framebuffer_ = 0, pixels_ = 0;
  cv::Size size_;
  cv::Scalar background_;
};

}  // namespace saccade
