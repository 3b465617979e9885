#pragma once

#include <span>

#include <imgui.h>
#include <opencv2/core.hpp>

#include "ui/drawing/damage_tracker.hpp"

namespace saccade {

/// The contents of the window, kept from frame to frame; only the damage is drawn. All calls with the same
/// OpenGL context current, in which ImGui's backend was started.
class CachedFramebuffer {
 public:
  CachedFramebuffer();
  ~CachedFramebuffer();
  CachedFramebuffer(const CachedFramebuffer&) = delete;
  CachedFramebuffer& operator=(const CachedFramebuffer&) = delete;

  /// Draws what differs from the last call over `background` (red, green, blue; 0..1). `renewed`: textures
  /// whose pixels have changed since. Returns whether anything was drawn. Cuts the clip rectangles of `data`.
  bool draw(ImDrawData& data, const cv::Scalar& background, std::span<const TextureId> renewed);

  /// The next call draws everything.
  void reset() { tracker_.reset(); }

  /// Copies the contents into the window.
  void show() const;

  /// BGR.
  [[nodiscard]] cv::Mat3b read_pixels() const;

 private:
  void resize(cv::Size size);

  DamageTracker tracker_;
  unsigned framebuffer_ = 0, pixels_ = 0;
  cv::Size size_;
  cv::Scalar background_;
};

}  // namespace saccade
