#pragma once

#include <imgui.h>
#include <opencv2/core.hpp>

namespace saccade {

/// A picture on the graphics card. All calls with the same OpenGL context current.
class Texture {
 public:
  Texture() = default;
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  /// BGR; the old picture's memory is used again if the size is the same.
  void upload(const cv::Mat3b& picture);

  /// Shows single pixels as squares, or blends them; returns whether that is new.
  bool set_sharp(bool sharp);

  ImTextureID id() const { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name_)); }
  bool empty() const { return name_ == 0; }

 private:
  unsigned name_ = 0;
  cv::Size size_;
  cv::Mat4b pixels_;  // BGRA, kept for its memory
  bool sharp_ = false;
};

}  // namespace saccade
